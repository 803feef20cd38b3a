import type { AlgorithmOnWorkload, ObjectMeasure, Stretch, Track, WorkloadResult } from '../api/types'
import { inOrder, listed } from './fastest'
import { SHOWN, type Shown } from './matrix'
import { readStretch } from './timeline'

/** Algorithms in the timeline unless the reader chooses. */
const LINES = 4

/** What the page of a replay shows: all of it is in the link. */
export interface View {
  order: Track
  /** The algorithms of this order, the fastest first; never empty in a result. */
  algorithms: { one: AlgorithmOnWorkload; ratio: number | null }[]
  /** Whose pairs the matrix shows. */
  algorithm: string
  shown: Shown
  /** Whose times the timeline shows. */
  lines: string[]
  stretch: Stretch | null
  /** A query, whose group is shown in space; the slowest group without it. */
  at: number | null
  /** The pair that is lit in the matrix and in the scene, the smaller place first. */
  pair: [number, number] | null
  /** The object with a heatmap, by its place in the scene. */
  object: number
  /** What its heatmap shows. */
  measure: ObjectMeasure
  /** On a logarithmic scale. */
  log: boolean
}

export const MEASURED: Record<ObjectMeasure, string> = { time: 'Time per query', wrong: 'Wrong answers', queries: 'Queries' }

/** Reads a link; missing values, and values that are not in the result, take their defaults. */
export function readView(query: Record<string, unknown>, result: WorkloadResult): View {
  const order = result.tracks.find(({ track }) => track === query['order'])?.track ?? result.tracks[0]?.track ?? 'shuffled'
  const algorithms = listed(inOrder(result, order))
  const ids = algorithms.map(({ one }) => one.algorithm)
  const algorithm = ids.find((id) => id === query['algorithm']) ?? ids[0] ?? ''
  const lines = typeof query['lines'] === 'string' ? query['lines'].split(',').filter((id) => ids.includes(id)) : []
  return {
    order, algorithms,
    algorithm,
    shown: (Object.keys(SHOWN) as Shown[]).find((shown) => shown === query['show']) ?? 'time',
    lines: lines.length > 0 ? lines : ids.slice(0, LINES),
    stretch: readStretch(query),
    at: /^\d{1,15}$/.test(String(query['at'])) ? Number(query['at']) : null,
    pair: pairIn(query['pair'], result),
    object: result.objects[placeIn(query['object'])] ? placeIn(query['object']) : dearest(algorithms.find(({ one }) => one.algorithm === algorithm)?.one),
    measure: (Object.keys(MEASURED) as ObjectMeasure[]).find((measure) => measure === query['measure']) ?? 'time',
    log: query['log'] === '1',
  }
}

const placeIn = (text: unknown): number => (/^\d{1,6}$/.test(String(text)) ? Number(text) : -1)

function pairIn(text: unknown, { objects }: Pick<WorkloadResult, 'objects'>): [number, number] | null {
  const [a = -1, b = -1, ...more] = String(text ?? '').split('-').map(placeIn)
  return more.length === 0 && a < b && objects[a] && objects[b] ? [a, b] : null
}

/** The object whose pairs take most of the time. */
function dearest(one: AlgorithmOnWorkload | undefined): number {
  const time = new Map<number, number>()
  for (const { objects, ns } of one?.pairs ?? []) for (const object of objects) time.set(object, (time.get(object) ?? 0) + ns)
  return [...time].toSorted(([a, x], [b, y]) => y - x || a - b)[0]?.[0] ?? 0
}

/** The link with these keys changed; undefined ones are removed. */
export function changed(query: Record<string, unknown>, part: Record<string, string | undefined>): Record<string, string> {
  const strings = Object.entries({ ...query, ...part }).filter((pair): pair is [string, string] => typeof pair[1] === 'string')
  return Object.fromEntries(strings)
}
