import { scaleLinear, scaleLog } from 'd3-scale'
import type { Advice, AdvicePoint } from '../api/types'
import { seriesStyle, type SeriesStyle } from '../charts/series-style'
import { logTicks } from '../explorer/ticks'
import { significant } from '../ui/format'
import { interval, ofSide, pointName, settingText, shareText, sizeText } from './words'

/** A way to answer as it is drawn. */
interface Family {
  kinds: readonly AdvicePoint['kind'][]
  name: string
  style: SeriesStyle
  /** Its points are settings of one thing: a line joins them. */
  joined?: true
}

/** Told apart by shape, and by colour: what is certified first. */
export const FAMILIES: readonly Family[] = [
  { kinds: ['levels'], name: 'levels of detail', style: seriesStyle(0), joined: true },
  { kinds: ['whole', 'same_question', 'yes_no'], name: 'whole objects', style: seriesStyle(1) },
  { kinds: ['advised'], name: 'advised', style: seriesStyle(3) },
  { kinds: ['hulls', 'boxes'], name: 'hulls and boxes*', style: seriesStyle(2) },
  { kinds: ['convex_parts'], name: 'convex parts*', style: seriesStyle(4), joined: true },
  { kinds: ['inner_spheres'], name: 'inner spheres*', style: seriesStyle(5), joined: true },
  { kinds: ['voxels'], name: 'voxels*', style: seriesStyle(6), joined: true },
  { kinds: ['double_precision', 'single_precision'], name: 'parry, f64 and f32*', style: seriesStyle(7) },
]
/** A shape in a word: `circle`. */
export const shape = ({ style }: Family): string => style.name.split(', ')[1] ?? ''

/** What of a point stands in the lower panel. */
interface Spot {
  y: number
  from: number
  to: number
  hollow: boolean
}
export interface Mark {
  point: AdvicePoint
  family: Family
  x: number
  y: number
  from: number
  to: number
  spots: Spot[]
  setting: string
  words: string
}
export interface Panel {
  top: number
  title: string
  ticks: { at: number; text: string }[]
}
export interface Plot {
  marks: Mark[]
  panels: Panel[]
  lines: { path: string; style: SeriesStyle }[]
  x: { at: number; value: number }[]
}

/** Heights of a panel, of what is above its marks and below them. */
export const PANEL = { height: 260, above: 26, below: 44 }
/** An error below this share of the longest side is as good as none: it has no place on a logarithmic axis. */
const NO_ERROR = 1e-12

/** Where everything stands between two edges: time above, errors below, over the size of the model. */
export function plot(advice: Advice, left: number, right: number): Plot {
  const { points } = advice
  const sizes = points.map(({ elements }) => Math.max(1, elements))
  const x = scaleLog([Math.min(...sizes) / 1.4, Math.max(...sizes) * 1.4], [left, right])
  const log = (values: number[], top: number) => {
    const scale = scaleLog([Math.min(...values) / 1.5, Math.max(...values) * 1.5], [top + PANEL.height - PANEL.below, top + PANEL.above])
    const [lo = 1, hi = 10] = scale.domain()
    return { scale, ticks: logTicks(lo, hi, 6).map((tick) => ({ tick, at: scale(tick) })) }
  }
  const times = log(points.flatMap(({ micros }) => [micros.lo, micros.hi]).filter((t) => t > 0), 0)
  const time: Panel = { top: 0, title: 'time of a query, µs (logarithmic)', ticks: times.ticks.map(({ tick, at }) => ({ at, text: significant(tick) })) }
  const { spots, panel } = advice.question.kind === 'distance' ? errors(advice, log) : shares()
  const marks = points.map((point) => {
    const family = FAMILIES.find(({ kinds }) => kinds.includes(point.kind))
    if (!family) throw new Error(`no family has ${point.kind}`)
    return {
      point, family, x: x(Math.max(1, point.elements)), y: times.scale(point.micros.value), from: times.scale(point.micros.lo), to: times.scale(point.micros.hi),
      spots: spots(point), setting: settingText(point), words: words(advice, point),
    }
  })
  const [lo = 1, hi = 10] = x.domain()
  return {
    marks,
    panels: [time, panel],
    lines: FAMILIES.filter(({ joined }) => joined).map((family) => ({ style: family.style, path: path(marks.filter((mark) => mark.family === family)) })),
    x: logTicks(lo, hi, right - left < 430 ? 5 : 8).map((value) => ({ value, at: x(value) })),
  }
}

function path(marks: Mark[]): string {
  return marks.toSorted((a, b) => a.x - b.x).map(({ x, y }, i) => `${i === 0 ? 'M' : 'L'}${x} ${y}`).join('')
}

/** The lower panel where distances are asked. */
function errors(advice: Advice, log: (values: number[], top: number) => { scale: (n: number) => number; ticks: { tick: number; at: number }[] }) {
  const share = (length: number | null | undefined) => (length ?? 0) / advice.longest_side
  const all = advice.points.flatMap((p) => [share(p.guaranteed_error), share(p.observed_error)]).filter((e) => e > NO_ERROR)
  const { scale, ticks } = log([1e-4, ...all], PANEL.height)
  const spot = (error: number, hollow: boolean): Spot[] => {
    if (error <= NO_ERROR) return []
    const y = scale(error)
    return [{ y, from: y, to: y, hollow }]
  }
  return {
    spots: (point: AdvicePoint) => [...spot(share(point.guaranteed_error), false), ...spot(share(point.observed_error), true)],
    panel: {
      top: PANEL.height, title: 'error, % of A’s longest side (logarithmic): filled guaranteed, hollow observed',
      ticks: ticks.map(({ tick, at }) => ({ at, text: significant(100 * tick) })),
    },
  }
}

/** The lower panel where a yes or no is asked: what is certified has no wrong answers, and no place in it. */
function shares() {
  const top = PANEL.height
  const scale = scaleLinear([0, 1], [top + PANEL.height - PANEL.below, top + PANEL.above])
  const spot = (share: AdvicePoint['missed'], hollow: boolean): Spot[] =>
    share && share.of > 0 ? [{ y: scale(share.seen / share.of), from: scale(share.lo), to: scale(share.hi), hollow }] : []
  return {
    spots: (point: AdvicePoint) => [...spot(point.false_alarms, false), ...spot(point.missed, true)],
    panel: {
      top, title: 'wrong answers, %: filled false alarms (of clear configurations), hollow missed (of the others)',
      ticks: [0, 0.25, 0.5, 0.75, 1].map((share) => ({ at: scale(share), text: significant(100 * share) })),
    },
  }
}

/** Everything about a point. */
function words(advice: Advice, point: AdvicePoint): string {
  const of = [`${pointName(advice, point)}: ${sizeText(point)}`, `${interval(point.micros)} µs`]
  if (point.observed_error !== null && point.observed_error !== undefined) of.push(`error observed ${ofSide(advice, point.observed_error)}`)
  if (point.false_alarms) of.push(`false alarms ${shareText(point.false_alarms)}`)
  if (point.missed) of.push(`missed ${shareText(point.missed)}`)
  return of.join(', ')
}
