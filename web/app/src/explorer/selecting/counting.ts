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

/** In which cell of a chart each configuration lies (rows from below); -1 for those that lie in none. */
export function places(xs: ArrayLike<number>, ys: ArrayLike<number>, x: Axis, y: Axis): Int32Array {
  const at = new Int32Array(xs.length)
  for (let i = 0; i < at.length; i++) {
    const column = cell(x, xs[i] ?? Number.NaN)
    const row = cell(y, ys[i] ?? Number.NaN)
    at[i] = column < 0 || row < 0 ? -1 : row * x.cells + column
  }
  return at
}

/** How many configurations lie in each of so many cells: those that are chosen, or all of them. */
export function counted(at: Int32Array, cells: number, chosen: Uint8Array | null): Uint32Array<ArrayBuffer> {
  const counts = new Uint32Array(cells)
  for (let i = 0; i < at.length; i++) {
    const place = at[i] ?? -1
    if (place >= 0 && (!chosen || chosen[i])) counts[place] = (counts[place] ?? 0) + 1
  }
  return counts
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

/** The configurations that have a value, by ascending values. */
export function ascending(values: ArrayLike<number>): Uint32Array {
  const having = Uint32Array.from({ length: values.length }, (_, i) => i).filter((i) => !Number.isNaN(values[i]))
  return having.toSorted((i, k) => (values[i] ?? 0) - (values[k] ?? 0))
}

/** The values of the selected configurations, ascending, from that order of all. */
export function sortedChosen(values: ArrayLike<number>, order: Uint32Array, chosen: Uint8Array): Float64Array {
  const out = new Float64Array(order.length)
  let n = 0
  for (const i of order) if (chosen[i]) out[n++] = values[i] ?? 0
  return out.subarray(0, n)
}
