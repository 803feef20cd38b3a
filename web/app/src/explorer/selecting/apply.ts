import type { Column, Predicate } from './language'

/** Where values come from: one per configuration, NaN where there is none. */
export interface Columns {
  column(column: Column, of: string | null): ArrayLike<number>
  /** Distance of every witness point on that object from a vertex, as a share of the longest side of the object's box. */
  fromVertex(body: 'a' | 'b', vertex: number): ArrayLike<number>
}

/** Which configurations belong to a selection: 1 or 0 each. */
export function apply(predicate: Predicate, columns: Columns): Uint8Array {
  switch (predicate.kind) {
    case 'range': {
      const { lo, hi } = predicate
      return mask(columns.column(predicate.column, predicate.of), (x) => lo <= x && x <= hi)
    }
    case 'flag':
      return mask(columns.column(predicate.column, predicate.of), (x) => x > 0)
    case 'near': {
      const { radius } = predicate
      return mask(columns.fromVertex(predicate.body, predicate.vertex), (x) => x <= radius)
    }
    case 'not':
      return apply(predicate.one, columns).map((x) => 1 - x)
    default: {
      const [first = new Uint8Array(0), ...others] = predicate.all.map((one) => apply(one, columns))
      for (const other of others) {
        for (let i = 0; i < first.length; i++) {
          const x = first[i] ?? 0
          const y = other[i] ?? 0
          first[i] = predicate.kind === 'all' ? x & y : x | y
        }
      }
      return first
    }
  }
}

function mask(values: ArrayLike<number>, holds: (x: number) => boolean): Uint8Array {
  const out = new Uint8Array(values.length)
  for (let i = 0; i < values.length; i++) out[i] = holds(values[i] ?? Number.NaN) ? 1 : 0
  return out
}

/** A logarithmic or linear axis of so many cells. */
export interface Axis {
  lo: number
  hi: number
  log: boolean
  cells: number
}

/** The cell of a value, or -1 where it lies outside or is none. */
export function cell({ lo, hi, log, cells }: Axis, value: number): number {
  const share = log ? Math.log(value / lo) / Math.log(hi / lo) : (value - lo) / (hi - lo)
  return share >= 0 && share <= 1 ? Math.min(cells - 1, Math.floor(share * cells)) : -1
}

/** How many configurations, and how many selected ones, lie in each cell of a chart (rows from below). */
export function density(
  xs: ArrayLike<number>, ys: ArrayLike<number>, x: Axis, y: Axis, chosen: Uint8Array | null,
): { all: Uint32Array<ArrayBuffer>; lit: Uint32Array<ArrayBuffer> } {
  const all = new Uint32Array(x.cells * y.cells)
  const lit = new Uint32Array(x.cells * y.cells)
  for (let i = 0; i < xs.length; i++) {
    const column = cell(x, xs[i] ?? Number.NaN)
    const row = cell(y, ys[i] ?? Number.NaN)
    if (column < 0 || row < 0) continue
    const at = row * x.cells + column
    all[at] = (all[at] ?? 0) + 1
    if (chosen?.[i]) lit[at] = (lit[at] ?? 0) + 1
  }
  return { all, lit }
}

/** An axis that holds all values: logarithmic over the positive ones when they span more than a tenth of a decade. */
export function axis(values: ArrayLike<number>, cells: number): Axis {
  let lo = Number.POSITIVE_INFINITY
  let hi = Number.NEGATIVE_INFINITY
  let zeros = false
  for (let i = 0; i < values.length; i++) {
    const value = values[i] ?? Number.NaN
    if (Number.isNaN(value)) continue
    if (value <= 0) zeros = true
    lo = Math.min(lo, value)
    hi = Math.max(hi, value)
  }
  if (!(hi >= lo)) return { lo: 0, hi: 1, log: false, cells }
  if (!zeros && hi / lo > 1.25) return { lo: lo / 1.02, hi: hi * 1.02, log: true, cells }
  const margin = (hi - lo) * 0.02 || Math.abs(hi) * 0.02 || 1
  return { lo: lo - margin, hi: hi + margin, log: false, cells }
}

/** Which vertices hear of a selected configuration: 1 or 0 each. */
export function litVertices(
  chosen: Uint8Array, triangleOf: ArrayLike<number>, corners: ArrayLike<number>, vertices: number,
): Float32Array<ArrayBuffer> {
  const lit = new Float32Array(vertices)
  for (let i = 0; i < chosen.length; i++) {
    if (!chosen[i]) continue
    const first = 3 * (triangleOf[i] ?? 0)
    for (let k = 0; k < 3; k++) lit[corners[first + k] ?? 0] = 1
  }
  return lit
}

/** The times of the selected configurations, ascending. */
export function sortedChosen(values: ArrayLike<number>, chosen: Uint8Array): Float64Array {
  const out = new Float64Array(values.length)
  let n = 0
  for (let i = 0; i < values.length; i++) {
    const value = values[i] ?? Number.NaN
    if (chosen[i] && !Number.isNaN(value)) out[n++] = value
  }
  return out.subarray(0, n).toSorted()
}
