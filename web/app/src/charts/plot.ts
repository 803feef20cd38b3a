import type { Chart, ChartPoint, ChartSeries } from '../api/types'
import { count, significant } from '../ui/format'
import { label, placing, type Placing } from './scale'

export interface Box { left: number; right: number; top: number; bottom: number }

export interface Place { x: number; y: number }

/** Places of a chart's points inside a box. */
export interface Plot {
  x: Placing
  y: Placing
  place: (point: ChartPoint) => Place
  across: (value: number) => number
  up: (value: number) => number
}

export function plot(chart: Chart, box: Box): Plot {
  const points = chart.series.flatMap((series) => series.points)
  const given = (values: (number | null | undefined)[]) => values.filter((value): value is number => value != null)
  const x = placing(chart.x, given(points.flatMap((p) => (p.x == null ? [] : [p.x, p.x_lo, p.x_hi]))))
  const y = placing(chart.y, given(points.flatMap((p) => [p.y, p.y_lo, p.y_hi])))
  const width = (share: number) => tenth(box.left + (box.right - box.left) * share)
  const height = (share: number) => tenth(box.bottom - (box.bottom - box.top) * share)
  return {
    x, y, across: (value) => width(x.at(value)), up: (value) => height(y.at(value)),
    place: (point) => ({ x: width(x.at(point.x)), y: height(y.at(point.y)) }),
  }
}

/** The line through a series; on a signed axis it breaks where the sign changes. */
export function path(chart: Chart, series: ChartSeries, { place }: Plot): string {
  return series.points
    .map((point, i) => {
      const before = series.points[i - 1]
      const { x, y } = place(point)
      const broken = chart.x.scale === 'signed' && before && Math.sign(before.x ?? 0) !== Math.sign(point.x ?? 0)
      if (!before || broken) return `M${x} ${y}`
      return series.form === 'steps' ? `H${x}V${y}` : `L${x} ${y}`
    })
    .join('')
}

/** The key: what stands for what, with how many values are behind it. Lines that only guide the eye are not in it. */
export function keys(chart: Chart): { name: string; style: number; form: ChartSeries['form']; n: number }[] {
  const all = new Map<string, { name: string; style: number; form: ChartSeries['form']; n: number }>()
  for (const { name, style, form, points } of chart.series) {
    if (form === 'rule') continue
    const known = all.get(name)
    const n = form === 'steps' ? (points.at(-1)?.n ?? 0) : points.reduce((sum, point) => sum + point.n, 0)
    all.set(name, { name, style: style ?? 0, form, n: n + (known?.n ?? 0) })
  }
  return [...all.values()]
}

/** One point in words. */
export function words(chart: Chart, series: ChartSeries, point: ChartPoint): string {
  if (point.words) return point.words
  const of = (value: number, unit: string) => label(value, unit)
  const interval = point.y_lo == null || point.y_hi == null ? '' : ` (${of(point.y_lo, chart.y.unit)} to ${of(point.y_hi, chart.y.unit)})`
  const x = point.x == null ? (chart.x.lane ?? '') : `at ${of(point.x, chart.x.unit)}`
  return `${series.name} ${x}: ${of(point.y, chart.y.unit)}${interval}, n = ${count(point.n)}.`
}

/** The whole chart to be read aloud: every named point, of curves the ends. */
export function aloud(chart: Chart): string {
  const lines = chart.series.filter(({ form, points }) => form !== 'rule' && points.length > 0)
  const told = lines.flatMap((series) => {
    const named = series.points.filter((point) => point.words)
    const ends = [series.points[0], ...(series.points.length > 1 ? [series.points.at(-1)] : [])]
    return (named.length > 0 ? named : ends).flatMap((point) => (point ? [words(chart, series, point)] : []))
  })
  return [chart.finding, `${chart.x.label} against ${chart.y.label}.`, ...told].filter(Boolean).join(' ')
}

/** What is wrong with a point, each with its colour: never one number for both. */
export function faults({ missed, false_alarms }: ChartPoint): { text: string; kind: 'missed' | 'alarms' }[] {
  return [
    ...(missed > 0 ? [{ text: `${significant(missed)} missed`, kind: 'missed' as const }] : []),
    ...(false_alarms > 0 ? [{ text: `${significant(false_alarms)} false alarms`, kind: 'alarms' as const }] : []),
  ]
}

/** Rough width of a letter. */
export const LETTER = 6.6
export const overlap = (a: Box, b: Box) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom

/** Length of the arrow of a point that is at least so far to the right. */
export const ARROW = 20

/** Where the words of an axis stand: inside a picture of this width, and none on what ends at `from`. */
export function below(ticks: readonly { at: number; text: string }[], box: Box, width: number, from: number): { text: string; x: number }[] {
  return ticks.flatMap(({ at, text }) => {
    const half = (text.length * LETTER) / 2
    const x = Math.min(box.left + (box.right - box.left) * at, width - half)
    return x - half < from ? [] : [{ text, x: tenth(x) }]
  })
}

/** Where the name of each mark begins, so that no two lie on each other or on an arrow; null where there is no room: the table has it. */
export function names(marks: readonly (Place & { letters: number; arrow: boolean })[], box: Box): (Place | null)[] {
  const reach = (arrow: boolean) => (arrow ? ARROW : 6)
  const taken = marks.map(({ x, y, arrow }): Box => ({ left: x - 6, right: x + reach(arrow), top: y - 6, bottom: y + 6 }))
  return marks.map(({ x, y, letters, arrow }) => {
    const width = letters * LETTER
    const lefts = [x + reach(arrow) + 4, x - 10 - width, x - width / 2]
    for (const dy of [4, -9, 17, -22, 30, -35, 43]) {
      for (const left of lefts) {
        const me = { left, right: left + width, top: y + dy - 10, bottom: y + dy + 3 }
        const inside = left >= box.left && me.right <= box.right && me.top >= box.top && me.bottom <= box.bottom
        if (!inside || taken.some((other) => overlap(me, other))) continue
        taken.push(me)
        return { x: left, y: y + dy }
      }
    }
    return null
  })
}

function tenth(n: number): number {
  return Math.round(n * 10) / 10
}
