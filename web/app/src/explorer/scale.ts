import { bisectRight } from 'd3-array'

/** How a value becomes a position on the colour map. `lo < hi`, and `lo > 0` when logarithmic. */
export interface ColourScale {
  log: boolean
  lo: number
  hi: number
}

/** What is coloured: values, failures (which begin at 0), or differences (which have 0 in the middle). */
export type ScaleKind = 'values' | 'failures' | 'differences'

/** `full`: smallest to largest value. `p2-98`: 2nd to 98th percentile, so that single vertices do not take all colours. */
export type RangeRule = 'full' | 'p2-98'

/** Position of a value on the map, 0 to 1; values beyond the ends take the end's colour. The shader computes the same. */
export function position(scale: ColourScale, value: number): number {
  const [lo, hi, v] = scale.log
    ? [Math.log(scale.lo), Math.log(scale.hi), Math.log(Math.max(value, Number.MIN_VALUE))]
    : [scale.lo, scale.hi, value]
  return Math.min(1, Math.max(0, (v - lo) / (hi - lo)))
}

/** The value at a position: the inverse of `position`. */
export function valueAt(scale: ColourScale, at: number): number {
  if (!scale.log) return scale.lo + at * (scale.hi - scale.lo)
  return Math.exp(Math.log(scale.lo) + at * (Math.log(scale.hi) - Math.log(scale.lo)))
}

/** All values of all maps, ascending, without the vertices that have none. */
export function sortedValues(maps: readonly (readonly (number | null)[])[]): Float64Array {
  let n = 0
  for (const map of maps) for (const value of map) if (value !== null) n++
  const all = new Float64Array(n)
  let at = 0
  for (const map of maps) for (const value of map) if (value !== null) all[at++] = value
  return all.toSorted()
}

/**
 * One scale for all maps on the screen, so that the same colour means the same value everywhere.
 *
 * A logarithmic scale starts at the smallest positive value; zeros are drawn in the lowest colour. Without any
 * positive value it falls back to linear. Equal ends are pulled apart a little, so that there is a middle.
 *
 * Failures are rare, so that percentiles would cut them off: their linear scale goes from 0 to the largest value, and
 * from 0 to 1 when there is none. Differences have 0 in the middle and are linear.
 */
export function sharedScale(
  sorted: Float64Array, wantLog: boolean, rule: RangeRule, kind: ScaleKind = 'values',
): ColourScale | null {
  if (sorted.length === 0) return null
  if (kind === 'differences') return balanced(sorted, rule)
  const largest = sorted.at(-1) ?? 0
  if (kind === 'failures' && (!wantLog || largest <= 0)) return { log: false, lo: 0, hi: largest > 0 ? largest : 1 }
  if (kind === 'failures') rule = 'full'
  const firstPositive = bisectRight(sorted, 0)
  const log = wantLog && firstPositive < sorted.length
  const used = log ? sorted.subarray(firstPositive) : sorted
  const [pLo, pHi] = rule === 'full' ? [0, 1] : [0.02, 0.98]
  const lo = quantile(used, pLo)
  const hi = quantile(used, pHi)
  if (hi > lo) return { log, lo, hi }
  const margin = log ? 1.05 : Math.max(Math.abs(lo) * 0.05, 1e-9)
  return log ? { log, lo: lo / margin, hi: hi * margin } : { log, lo: lo - margin, hi: hi + margin }
}

/** As far below 0 as above it. */
function balanced(sorted: Float64Array, rule: RangeRule): ColourScale {
  const ends = rule === 'full' ? [0, 1] : [0.02, 0.98]
  const within = Math.max(...ends.map((q) => Math.abs(quantile(sorted, q))))
  const reach = within || Math.max(Math.abs(sorted[0] ?? 0), Math.abs(sorted.at(-1) ?? 0)) || 1
  return { log: false, lo: -reach, hi: reach }
}

/** Counts of values per slice of the scale, low end first: the histogram beside the legend. */
export function histogram(sorted: Float64Array, scale: ColourScale, bins: number): number[] {
  const counts = Array.from({ length: bins }, () => 0)
  for (const value of sorted) {
    const bin = Math.min(bins - 1, Math.floor(position(scale, value) * bins))
    counts[bin] = (counts[bin] ?? 0) + 1
  }
  return counts
}

/** Quantile of ascending values, linear between neighbours (d3's own takes no typed array by its types). */
export function quantile(sorted: Float64Array, q: number): number {
  const at = q * (sorted.length - 1)
  const below = sorted[Math.floor(at)] ?? Number.NaN
  const above = sorted[Math.ceil(at)] ?? below
  return below + (above - below) * (at - Math.floor(at))
}
