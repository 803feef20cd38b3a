import { scaleLinear } from 'd3-scale'
import { position, type ColourScale } from './scale'

/** A labelled place on the legend. */
export interface Tick {
  value: number
  /** 0 at the low end, 1 at the high end. */
  at: number
}

/**
 * Round numbers inside the scale, at most `limit`, never closer together than a label is high.
 *
 * A logarithmic scale takes the densest of 1-2-5, 1-3 and 1 per decade that fits; when not even two of those lie inside
 * (a narrow range), linear ticks.
 */
export function legendTicks(scale: ColourScale, limit = 6): Tick[] {
  const values = scale.log ? logTicks(scale.lo, scale.hi, limit) : scaleLinear([scale.lo, scale.hi], [0, 1]).ticks(limit - 1)
  return values
    .filter((value) => value >= scale.lo && value <= scale.hi)
    .map((value) => ({ value, at: position(scale, value) }))
}

const MANTISSAS = [[1, 2, 5], [1, 3], [1]]

/** Round values of a logarithmic axis, ascending. (d3's own turn linear once it finds fewer than half of what it is asked for.) */
export function logTicks(lo: number, hi: number, limit: number): number[] {
  const first = Math.floor(Math.log10(lo))
  const decades = Array.from({ length: Math.ceil(Math.log10(hi)) - first + 1 }, (_, i) => first + i)
  const all = MANTISSAS.map((mantissas) =>
    decades
      .flatMap((decade) => mantissas.map((m) => Number(`${m}e${decade}`)))
      .filter((value) => value >= lo && value <= hi),
  )
  const fitting = all.find((values) => values.length <= limit)
  if (fitting && fitting.length >= 2) return fitting
  const whole = all.at(-1) ?? []
  if (whole.length > limit) return whole.filter((_, i) => i % Math.ceil(whole.length / limit) === 0)
  const two = all.find((values) => values.length >= 2 && values.length <= limit + 2)
  return two ?? scaleLinear([lo, hi], [0, 1]).ticks(Math.min(4, limit - 1))
}
