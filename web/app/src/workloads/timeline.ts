import type { Stretch, Timeline, TimelineSeries } from '../api/types'
import type { SeriesStyle } from '../charts/series-style'
import { time } from '../ui/format'

/** One part of the recording, for one algorithm. */
export interface Part {
  from: number
  /** The query behind its last one. */
  to: number
  n: number
  /** Nanoseconds per query; null where nothing was asked. */
  each: number | null
  wrong: number
}

/** Behind the last query of the recording; queries that were left out at its end are not known. */
export const endOf = ({ from, queries }: Timeline): number => (from.at(-1) ?? 0) + (queries.at(-1) ?? 0)

const behind = (timeline: Timeline, part: number): number => timeline.from[part + 1] ?? endOf(timeline)

export function parts(timeline: Timeline, { n, ns, wrong }: TimelineSeries): Part[] {
  return timeline.from.map((from, i) => ({
    from, to: behind(timeline, i), n: n[i] ?? 0, each: (n[i] ?? 0) > 0 ? (ns[i] ?? 0) / (n[i] ?? 1) : null, wrong: wrong[i] ?? 0,
  }))
}

/** The share of certainly colliding queries in each part. */
export const hitShares = ({ queries, hits }: Timeline): number[] => queries.map((n, i) => (n > 0 ? (hits[i] ?? 0) / n : 0))

/** The stretch of all parts that lie between two places of the recording, in either order; the ends of the recording are left open. */
export function stretchBetween(timeline: Timeline, a: number, b: number): Stretch {
  const last = timeline.from.length - 1
  const at = (query: number) => Math.max(0, timeline.from.findLastIndex((from) => from <= query))
  const [first, final] = [at(Math.min(a, b)), at(Math.max(a, b))]
  return {
    ...(first > 0 && { from: timeline.from[first] ?? 0 }),
    ...(final < last && { to: behind(timeline, final) }),
  }
}

/** The typed first and last query as a stretch, or why they are not one. */
export function stretchTyped(timeline: Timeline, first: number | '', last: number | ''): { stretch: Stretch } | { problem: string } {
  const given = [first, last].filter((value) => value !== '')
  if (given.length === 0) return { problem: 'Give the first or the last query of the stretch.' }
  if (given.some((value) => !Number.isSafeInteger(value) || value < 0)) return { problem: 'Queries have whole numbers, from 0.' }
  if (first !== '' && last !== '' && first > last) return { problem: 'The first query must not be behind the last one.' }
  if (first !== '' && first >= endOf(timeline)) return { problem: `The last query has the number ${endOf(timeline) - 1}.` }
  return { stretch: { ...(first !== '' && { from: first }), ...(last !== '' && { to: last + 1 }) } }
}

/** The stretch in a link; null where there is none. Text that is not a number is left out. */
export function readStretch(query: Record<string, unknown>): Stretch | null {
  const number = (raw: unknown) => (typeof raw === 'string' && /^\d{1,15}$/.test(raw) ? Number(raw) : undefined)
  const [from, to] = [number(query['from']), number(query['to'])]
  if (from === undefined && to === undefined) return null
  if (from !== undefined && to !== undefined && from >= to) return null
  return { ...(from !== undefined && { from }), ...(to !== undefined && { to }) }
}

/** A stretch for the link; empty for none. */
export const writeStretch = (stretch: Stretch | null): Record<string, string> =>
  Object.fromEntries(Object.entries(stretch ?? {}).map(([end, query]) => [end, String(query)]))

/** A stretch in words, with its first and its last query. */
export function stretchWords(timeline: Timeline, { from = timeline.from[0] ?? 0, to = endOf(timeline) }: Stretch): string {
  return `queries ${from.toLocaleString('en-GB')} to ${(to - 1).toLocaleString('en-GB')}`
}

/** A line of the timeline. */
export interface Line {
  name: string
  series: TimelineSeries
  style: SeriesStyle
}

/** The timeline to be read aloud. */
export function aloud(timeline: Timeline, lines: readonly Line[]): string {
  const told = lines.map(({ name, series, style }) => {
    const timed = parts(timeline, series).flatMap((part) => (part.each ? [{ ...part, each: part.each }] : []))
    if (timed.length === 0) return `${name}: nothing measured.`
    const sorted = timed.toSorted((a, b) => a.each - b.each)
    const [least, most] = [sorted[0], sorted.at(-1)]
    const wrong = series.wrong.reduce((sum, n) => sum + n, 0)
    return `${name} (${style.name}): ${time(least?.each ?? 0)} to ${time(most?.each ?? 0)} per query, slowest in ${most ? stretchWords(timeline, most) : ''}; ${wrong === 0 ? 'no' : wrong} wrong ${wrong === 1 ? 'answer' : 'answers'}.`
  })
  return [`${timeline.from.length} parts of the recording, ${stretchWords(timeline, {})}.`, ...told].join(' ')
}
