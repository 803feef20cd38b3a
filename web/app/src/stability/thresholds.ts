import type { FamilyInfo, StabilityTable } from '../api/types'

/** Which of the queries' times. */
export type Timed = 'collision' | 'distance'

/** Where an algorithm fails in a family, and what its queries there take. */
export interface Point {
  algorithm: string
  name: string
  /** The first failing value; null when it did not fail at any tested one. */
  fails: number | null
  /** Median over the values of the parameter of the median time, and the smallest and largest of these, nanoseconds. */
  ns: number
  range: [number, number]
  /** Queries. */
  n: number
}

/** The families whose parameter is a size that gets harder as it gets smaller. */
export function chartable({ families, methods }: Pick<StabilityTable, 'families' | 'methods'>, timed: Timed): FamilyInfo[] {
  return families.filter((family) => family.continuous && family.harder === 'small' && points(methods, family.id, timed).length > 0)
}

export function points(methods: StabilityTable['methods'], family: string, timed: Timed): Point[] {
  return methods.flatMap(({ algorithm, name, families }) => {
    const found = families.find((one) => one.family === family)
    const times = (found?.steps ?? []).flatMap((step) => step[timed] ?? [])
    const sorted = times.map(({ median_ns }) => median_ns).toSorted((a, b) => a - b)
    const [least, most] = [sorted[0], sorted.at(-1)]
    if (!found || least === undefined || most === undefined) return []
    const middle = (sorted.length - 1) / 2
    const ns = ((sorted[Math.floor(middle)] ?? 0) + (sorted[Math.ceil(middle)] ?? 0)) / 2
    // Below the resolution of the clock nothing can be drawn on a logarithmic axis.
    const shown = (value: number) => Math.max(value, 1)
    return [{
      algorithm, name, fails: found.thresholds[0]?.fails ?? null,
      ns: shown(ns), range: [shown(least), shown(most)] as [number, number], n: times.reduce((sum, { n }) => sum + n, 0),
    }]
  })
}

/** The smallest value that was tested. */
export const smallest = (methods: StabilityTable['methods'], family: string): number =>
  Math.min(...methods.flatMap(({ families }) => families.find((one) => one.family === family)?.steps.map(({ at }) => at) ?? []))
