/** The closest points of a run on one object, and how dense they lie. */
export interface Cloud {
  side: 'a' | 'b'
  /** Three numbers per point, in the object's frame. */
  positions: Float32Array
  /** The configuration behind each point. */
  records: Uint32Array
  /** Points within `RADIUS` of each point, itself included. */
  near: Uint32Array
  /** Points there are; more than are drawn when only every k-th is. */
  of: number
}

/** How far "near" reaches, for the colours and for a click: as a share of the longest side of the object's box. */
export const RADIUS = 0.05
/** At most so many points are drawn and counted. */
export const MOST_POINTS = 50_000
/** Cells per radius: the more, the fewer points are compared one by one. */
const CELLS = 4
const MOST_CELLS = 128

/** The points that there are (a configuration may have none), or every k-th of them so that there are not too many. */
export function thinned(
  x: ArrayLike<number>, y: ArrayLike<number>, z: ArrayLike<number>, most = MOST_POINTS,
): Pick<Cloud, 'positions' | 'records' | 'of'> {
  const there = Uint32Array.from({ length: x.length }, (_, i) => i).filter((i) => Number.isFinite((x[i] ?? Number.NaN) + (y[i] ?? 0) + (z[i] ?? 0)))
  const step = Math.max(1, Math.ceil(there.length / most))
  const records = there.filter((_, i) => i % step === 0)
  const positions = new Float32Array(3 * records.length)
  records.forEach((record, i) => positions.set([x[record] ?? 0, y[record] ?? 0, z[record] ?? 0], 3 * i))
  return { positions, records, of: there.length }
}

/**
 * How many points lie within a radius of each, itself included. Points are sorted into cubes; cubes that lie within
 * the radius as a whole are counted as a whole, so that dense places cost less.
 */
export function within(positions: Float32Array, radius: number): Uint32Array {
  const n = positions.length / 3
  const counts = new Uint32Array(n)
  const grid = sorted(positions, radius)
  const { side, dims, starts, order, cells } = grid
  const [whole, border] = neighbours(radius, side)
  const square = radius * radius
  for (let first = 0; first < n; ) {
    const cell = cells[order[first] ?? 0] ?? 0
    const end = starts[cell + 1] ?? n
    const at = [cell % dims[0], Math.floor(cell / dims[0]) % dims[1], Math.floor(cell / (dims[0] * dims[1]))] as const
    const sure = spans(grid, at, whole).reduce((sum, [from, to]) => sum + to - from, 0)
    const open = spans(grid, at, border)
    for (let i = first; i < end; i++) {
      const me = 3 * (order[i] ?? 0)
      let count = sure
      for (const [from, to] of open) {
        for (let k = from; k < to; k++) {
          const other = 3 * (order[k] ?? 0)
          const dx = (positions[other] ?? 0) - (positions[me] ?? 0)
          const dy = (positions[other + 1] ?? 0) - (positions[me + 1] ?? 0)
          const dz = (positions[other + 2] ?? 0) - (positions[me + 2] ?? 0)
          if (dx * dx + dy * dy + dz * dz <= square) count++
        }
      }
      counts[me / 3] = count
    }
    first = end
  }
  return counts
}

type Offset = readonly [number, number, number]
type Grid = ReturnType<typeof sorted>

/** Points by cell: those of cell c are `order[starts[c]]` up to `order[starts[c + 1]]`. */
function sorted(positions: Float32Array, radius: number) {
  const n = positions.length / 3
  const lo = [Infinity, Infinity, Infinity]
  const hi = [-Infinity, -Infinity, -Infinity]
  positions.forEach((value, i) => {
    lo[i % 3] = Math.min(lo[i % 3] ?? 0, value)
    hi[i % 3] = Math.max(hi[i % 3] ?? 0, value)
  })
  const longest = n > 0 ? Math.max(...hi.map((value, k) => value - (lo[k] ?? 0))) : 0
  const side = Math.max(radius / CELLS, longest / MOST_CELLS)
  const along = (value: number, k: number) => Math.floor((value - (lo[k] ?? 0)) / side)
  const dims = [0, 1, 2].map((k) => (n > 0 ? along(hi[k] ?? 0, k) + 1 : 1)) as [number, number, number]
  const cells = new Uint32Array(n)
  const starts = new Uint32Array(dims[0] * dims[1] * dims[2] + 1)
  for (let i = 0; i < n; i++) {
    const [x, y, z] = [0, 1, 2].map((k) => along(positions[3 * i + k] ?? 0, k)) as [number, number, number]
    const cell = x + dims[0] * (y + dims[1] * z)
    cells[i] = cell
    starts[cell + 1] = (starts[cell + 1] ?? 0) + 1
  }
  for (let c = 1; c < starts.length; c++) starts[c] = (starts[c] ?? 0) + (starts[c - 1] ?? 0)
  const next = starts.slice()
  const order = new Uint32Array(n)
  cells.forEach((cell, i) => {
    order[next[cell] ?? 0] = i
    next[cell] = (next[cell] ?? 0) + 1
  })
  return { side, dims, starts, order, cells }
}

/** Cells around a cell: those whose points all lie within the radius of all its points, and those that may have some. */
function neighbours(radius: number, side: number): [Offset[], Offset[]] {
  const reach = Math.ceil(radius / side) + 1
  const steps = Array.from({ length: 2 * reach + 1 }, (_, i) => i - reach)
  const all = steps.flatMap((z) => steps.flatMap((y) => steps.map((x): Offset => [x, y, z])))
  const distance = (offset: Offset, change: number) => Math.hypot(...offset.map((d) => Math.max(0, Math.abs(d) + change))) * side
  const isWhole = (offset: Offset) => distance(offset, 1) < radius * (1 - 1e-6)
  return [all.filter(isWhole), all.filter((offset) => !isWhole(offset) && distance(offset, -1) <= radius * (1 + 1e-6))]
}

/** Where the points of these cells stand in the order. */
function spans({ dims, starts }: Grid, [ax, ay, az]: Offset, offsets: readonly Offset[]): [number, number][] {
  const found: [number, number][] = []
  for (const [dx, dy, dz] of offsets) {
    const x = ax + dx
    const y = ay + dy
    const z = az + dz
    if (x < 0 || y < 0 || z < 0 || x >= dims[0] || y >= dims[1] || z >= dims[2]) continue
    const cell = x + dims[0] * (y + dims[1] * z)
    const from = starts[cell] ?? 0
    const to = starts[cell + 1] ?? 0
    if (to > from) found.push([from, to])
  }
  return found
}
