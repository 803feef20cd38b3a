import type { AlgorithmOnWorkload, Track, WorkloadResult } from '../api/types'

/** It answered all queries that it can be asked, none of them wrongly: its time may be compared. */
export function isFair({ n, of, wrong, silent, ended }: AlgorithmOnWorkload): boolean {
  return n === of && n > 0 && wrong === 0 && silent === 0 && ended.length === 0
}

/** Time of all queries together; infinite where there is none. */
export const together = ({ total }: AlgorithmOnWorkload): number => total?.ns ?? Number.POSITIVE_INFINITY

/** The algorithms of an order. */
export const inOrder = ({ tracks }: WorkloadResult, track: Track): AlgorithmOnWorkload[] =>
  tracks.find((one) => one.track === track)?.algorithms ?? []

/** Those whose times may be compared with one another, the fastest first: all fair ones that were asked the most. */
export function comparable(algorithms: readonly AlgorithmOnWorkload[]): AlgorithmOnWorkload[] {
  const fair = algorithms.filter((one) => isFair(one) && one.total != null)
  const most = Math.max(...fair.map(({ n }) => n))
  return fair.filter(({ n }) => n === most).toSorted((a, b) => together(a) - together(b))
}

/** All of an order: the comparable ones, the fastest first, then the others as they came. */
export function listed(algorithms: readonly AlgorithmOnWorkload[]): { one: AlgorithmOnWorkload; ratio: number | null }[] {
  const ranked = comparable(algorithms)
  const [best] = ranked
  return [...ranked, ...algorithms.filter((one) => !ranked.includes(one))].map((one) => ({
    one, ratio: best && ranked.includes(one) ? together(one) / together(best) : null,
  }))
}

/** The fastest, how many times as fast it is as the next, and those that may be as fast: their ranges overlap its range. */
export interface Standing {
  fastest: AlgorithmOnWorkload
  next: { one: AlgorithmOnWorkload; ratio: number } | null
  tied: AlgorithmOnWorkload[]
}

export function standing(algorithms: readonly AlgorithmOnWorkload[]): Standing | null {
  const [fastest, ...others] = comparable(algorithms)
  if (!fastest) return null
  const [one] = others
  // Not the next alone: one that is slower on the whole may have the wider range.
  const tied = others.filter(({ total }) => (total?.lowest_ns ?? 0) <= (fastest.total?.highest_ns ?? 0))
  return { fastest, next: one ? { one, ratio: together(one) / together(fastest) } : null, tied }
}

/** How many times as fast an algorithm is in the order of the recording; `apart` is false where the ranges overlap. */
export interface Gain {
  ratio: number
  apart: boolean
}

export function gain(result: WorkloadResult, algorithm: string): Gain | null {
  const of = (track: Track) => inOrder(result, track).find((one) => one.algorithm === algorithm)
  const [shuffled, recorded] = [of('shuffled'), of('recorded')]
  if (!shuffled?.total || !recorded?.total || shuffled.n !== recorded.n || recorded.total.ns <= 0) return null
  const apart = shuffled.total.lowest_ns > recorded.total.highest_ns || recorded.total.lowest_ns > shuffled.total.highest_ns
  return { ratio: shuffled.total.ns / recorded.total.ns, apart }
}
