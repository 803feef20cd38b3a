import type { Axis } from '../api/types'
import { logTicks } from '../explorer/ticks'
import { significant, time } from '../ui/format'

/** From numbers to places on an axis: 0 at the near end, 1 at the far one. */
export interface Placing {
  at: (value: number | null | undefined) => number
  ticks: (atMost: number) => { at: number; text: string }[]
  /** Where the lane for points without a value ends; 0 without one. */
  lane: number
}

const LANE = 0.17

/** The axis with ends a little beyond all values; as the files of the command line have it. */
export function placing(axis: Axis, all: readonly number[]): Placing {
  const values = all.filter((x) => Number.isFinite(x) && (axis.scale !== 'log' || x > 0))
  const sizes = values.map(Math.abs).filter((x) => x > 0)
  const smallest = sizes.length > 0 ? Math.min(...sizes) : 1
  const along = (x: number) => {
    if (axis.scale === 'linear' || axis.scale === 'rows') return x
    if (axis.scale === 'log') return Math.log10(Math.max(x, Number.MIN_VALUE))
    return x === 0 ? 0 : Math.sign(x) * (1 + Math.max(0, Math.log10(Math.abs(x) / smallest)))
  }
  const [lo, hi] = ends(axis, values.map(along))
  const lane = axis.lane == null ? 0 : LANE
  const at = (x: number | null | undefined) =>
    x == null ? lane / 2 : lane + (1 - lane) * Math.min(1, Math.max(0, (along(x) - lo) / (hi - lo)))
  const round = (atMost: number): number[] => {
    if (axis.scale === 'signed') return bothWays(lo, hi, smallest, atMost)
    if (axis.scale === 'log') return logTicks(10 ** lo, 10 ** hi, atMost)
    return evenly(lo, hi, atMost)
  }
  return { at, lane, ticks: (atMost) => round(atMost).map((x) => ({ at: at(x), text: label(x, axis.unit) })) }
}

function ends(axis: Axis, values: readonly number[]): [number, number] {
  // Without values a share has its own range, and nothing else minds.
  if (values.length === 0) return axis.scale === 'linear' ? [0, 1] : [-4, 0]
  const lo = Math.min(...values)
  const hi = Math.max(...values)
  if (axis.scale === 'linear' || axis.scale === 'rows') return [Math.min(0, lo), hi > 0 ? 1.05 * hi : 1]
  const room = Math.max(0.15, 0.05 * (hi - lo))
  return [lo - room, hi + room]
}

function evenly(lo: number, hi: number, atMost: number): number[] {
  const rough = (hi - lo) / Math.max(2, atMost)
  const decade = 10 ** Math.floor(Math.log10(rough))
  const step = decade * ([1, 2, 5, 10].find((m) => m * decade >= rough) ?? 10)
  const first = Math.ceil(lo / step)
  return Array.from({ length: Math.floor(hi / step) - first + 1 }, (_, i) => (first + i) * step)
}

/** Powers of ten in both directions from the smallest value. */
function bothWays(lo: number, hi: number, smallest: number, atMost: number): number[] {
  const start = Math.log10(smallest)
  const first = Math.ceil(start)
  const last = (end: number) => (end > 1 ? Math.floor(start + end - 1) : first - 1)
  const decades = (end: number) => Array.from({ length: Math.max(0, last(end) - first + 1) }, (_, i) => last(end) - i)
  const every = Math.max(1, Math.ceil((decades(-lo).length + decades(hi).length) / atMost))
  const thin = (all: number[]) => all.filter((_, i) => i % every === 0)
  return [...thin(decades(-lo)).map((d) => -(10 ** d)), ...thin(decades(hi)).map((d) => 10 ** d)]
}

const THOUSANDS: [number, string][] = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k']]

/** A value in its unit, short. */
export function label(value: number, unit: string): string {
  if (unit === 'ns') return time(value)
  if (unit === 'share' && (value === 0 || Math.abs(value) >= 0.999e-3)) return `${significant(100 * value)} %`
  if (unit === '1/s') {
    const [factor, name] = THOUSANDS.find(([size]) => Math.abs(value) >= 0.999 * size) ?? [1, '']
    return `${significant(value / factor)} ${name}`.trim()
  }
  const size = Math.abs(value)
  return size > 0 && (size < 0.999e-2 || size >= 99_999) ? value.toExponential(0) : significant(value)
}
