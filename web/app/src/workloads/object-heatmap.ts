import type { ObjectHeatmap, ObjectMeasure } from '../api/types'
import { coverage } from '../explorer/datum'
import { histogram, sharedScale, sortedValues } from '../explorer/scale'
import { LEGEND_BARS, type LegendData } from '../explorer/use-legend'
import { count, value as withUnit } from '../ui/format'

/** What it means that a vertex has no colour. */
export const UNTOUCHED = 'no query touched this'

const NAME: Record<ObjectMeasure, string> = {
  time: 'Mean of time per query', wrong: 'Share of wrong answers', queries: 'Queries with their closest or crossing triangle here',
}

/** Shares are on a linear scale from 0. */
export const mayBeLog = (measure: ObjectMeasure): boolean => measure !== 'wrong'

/** Only of a mean it matters that a vertex has few values. */
export const fadesFew = (measure: ObjectMeasure): boolean => measure === 'time'

/** The legend of a heatmap; null where no vertex has a value. */
export function legendOf(map: ObjectHeatmap, log: boolean): LegendData | null {
  const { request: { measure }, unit, n } = map
  const sorted = sortedValues([map.values])
  const scale = sharedScale(sorted, log && mayBeLog(measure), 'full', measure === 'wrong' ? 'failures' : 'values')
  if (!scale) return null
  const covered = coverage([map])
  return {
    scale, unit, n, name: NAME[measure], range: [sorted[0] ?? 0, sorted.at(-1) ?? 0], bars: histogram(sorted, scale, LEGEND_BARS),
    coverage: fadesFew(measure) ? covered : { ...covered, few: 0 },
  }
}

/** What the picture shows, in a sentence. */
export function heatmapWords({ request: { measure }, values, counts, n, unit, range }: ObjectHeatmap, object: string): string {
  const reached = values.filter((value) => value !== null).length
  if (!range) return `No query about ${object} in this part of the recording was answered by this algorithm.`
  const of = `${count(n)} ${n === 1 ? 'query' : 'queries'} about ${object} ${n === 1 ? 'reaches' : 'reach'} ${count(reached)} of its ${count(values.length)} vertices`
  const [, largest = 0] = range
  const top = values.indexOf(largest)
  if (measure === 'wrong' && largest === 0) return `${of}; no answer is wrong.`
  const most = { time: 'the longest mean', wrong: 'the largest share of wrong answers', queries: 'the most' }[measure]
  return `${of}; ${most}, ${withUnit(largest, unit)}, is at vertex ${top} with n = ${count(counts[top] ?? 0)}.`
}
