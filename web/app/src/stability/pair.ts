import type { FailingCase } from '../api/types'

export type Vector = readonly [number, number, number]

/** The corners of every triangle of an OBJ text of ours, placed by a row-major matrix. */
export function placed(obj: string, pose: readonly string[]): Vector[][] {
  const m = pose.map(Number)
  const at = (i: number) => m[i] ?? 0
  const vertices: Vector[] = []
  const triangles: Vector[][] = []
  for (const line of obj.split('\n')) {
    const [kind, ...words] = line.split(' ')
    const [a = 0, b = 0, c = 0] = words.map(Number)
    if (kind === 'v') {
      const row = (r: number) => at(4 * r) * a + at(4 * r + 1) * b + at(4 * r + 2) * c + at(4 * r + 3)
      vertices.push([row(0), row(1), row(2)])
    } else if (kind === 'f') {
      triangles.push([a, b, c].flatMap((i) => { const found = vertices[i - 1]; return found ? [found] : [] }))
    }
  }
  return triangles.filter((triangle) => triangle.length === 3 && triangle.flat().every(Number.isFinite))
}

export interface Drawn {
  side: 'a' | 'b'
  depth: number
  points: string
}

/** Both objects as seen after two turns (degrees), within a square of this size, the farthest first. */
export function drawing(repro: FailingCase, turn: number, tilt: number, size: number): Drawn[] {
  const [sine, cosine] = [Math.sin((turn * Math.PI) / 180), Math.cos((turn * Math.PI) / 180)]
  const [sineTilt, cosineTilt] = [Math.sin((tilt * Math.PI) / 180), Math.cos((tilt * Math.PI) / 180)]
  const sides = [
    ...placed(repro.a, repro.pose_a).map((triangle) => ({ side: 'a' as const, triangle })),
    ...placed(repro.b, repro.pose_b).map((triangle) => ({ side: 'b' as const, triangle })),
  ]
  const turned = sides.map(({ side, triangle }) => ({
    side,
    corners: triangle.map(([x, y, z]): Vector => {
      const [u, w] = [x * cosine - y * sine, x * sine + y * cosine]
      return [u, w * cosineTilt - z * sineTilt, w * sineTilt + z * cosineTilt]
    }),
  }))
  const all = turned.flatMap(({ corners }) => corners)
  const range = (k: 0 | 1 | 2) => [Math.min(...all.map((p) => p[k])), Math.max(...all.map((p) => p[k]))] as const
  const [[left, right], [low, high]] = [range(0), range(2)]
  const scale = (size * 0.88) / Math.max(right - left, high - low, Number.MIN_VALUE)
  const place = ([x, , z]: Vector) =>
    `${(size / 2 + (x - (left + right) / 2) * scale).toFixed(1)},${(size / 2 - (z - (low + high) / 2) * scale).toFixed(1)}`
  return turned
    .map(({ side, corners }) => ({ side, depth: Math.max(...corners.map((p) => p[1])), points: corners.map(place).join(' ') }))
    .toSorted((one, other) => other.depth - one.depth)
}
