import { Ray, TorusKnotGeometry, Vector3 } from 'three'
import { describe, expect, it } from 'vitest'
import { buildBvh, nearestCorner, pick } from './picking'

const knot = () => new TorusKnotGeometry(1, 0.3, 120, 16)

/** The first triangle on a ray, found by asking every one of them. */
function bruteForce(geometry: ReturnType<typeof knot>, ray: Ray): number {
  const position = geometry.getAttribute('position')
  const [a, b, c, at] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()]
  let best = -1
  let nearest = Number.POSITIVE_INFINITY
  const index = geometry.index
  if (!index) throw new Error('the knot is indexed')
  for (let t = 0; t < index.count / 3; t++) {
    a.fromBufferAttribute(position, index.getX(3 * t))
    b.fromBufferAttribute(position, index.getX(3 * t + 1))
    c.fromBufferAttribute(position, index.getX(3 * t + 2))
    if (ray.intersectTriangle(a, b, c, false, at) && at.distanceTo(ray.origin) < nearest) {
      nearest = at.distanceTo(ray.origin)
      best = t
    }
  }
  return best
}

describe('buildBvh', () => {
  it('leaves the index buffer as it was: triangle numbers are those of the benchmark', () => {
    const geometry = knot()
    const before = Uint32Array.from(geometry.index?.array ?? [])
    buildBvh(geometry)
    expect(before.length).toBeGreaterThan(5000)
    expect(Uint32Array.from(geometry.index?.array ?? [])).toEqual(before)
  })

  it('names the triangle of the file that a ray meets first', () => {
    const geometry = knot()
    const bvh = buildBvh(geometry)
    let hits = 0
    for (let i = 0; i < 40; i++) {
      const origin = new Vector3(Math.cos(i) * 4, Math.sin(i * 1.7) * 4, Math.sin(i) * 4)
      const ray = new Ray(origin, origin.clone().negate().add(new Vector3(Math.sin(i * 3), Math.cos(i * 5), 0)).normalize())
      const expected = bruteForce(geometry, ray)
      expect(pick(bvh, ray)?.triangle ?? -1).toBe(expected)
      if (expected >= 0) hits++
    }
    expect(hits).toBeGreaterThan(10)
  })
})

it('reads the corner next to the place', () => {
  const geometry = knot()
  const vertex = geometry.index?.getX(3 * 77 + 1) ?? -1
  const at = new Vector3().fromBufferAttribute(geometry.getAttribute('position'), vertex).addScalar(1e-4)
  expect(nearestCorner(geometry, 77, at)).toBe(vertex)
})
