import type { AlgorithmResult } from '../api/types'
import { count, significant } from '../ui/format'
import { classWords } from './ranking'

/** One algorithm between fast and right. */
export interface Point {
  name: string
  /** Questions per second, by the median time, with its 95 % interval. */
  rate: number
  rates: [number, number]
  /** Decimal digits of the scene's size that it tells apart, -log10 of eps*. */
  digits: number
  /** No wrong answer was seen: it may well have more digits than the configurations could show. */
  atLeast: boolean
  wrong: number
  missed: number
  n: number
  /** Nothing else is faster and as accurate. */
  frontier: boolean
  /** In short, beside the name. */
  reading: string
  /** In full, to be read aloud. */
  words: string
}

/** The algorithms that have a time and an accuracy; the rest stands in the table, with the reason. */
export function points(results: readonly AlgorithmResult[]): Point[] {
  const all = results.flatMap((result): Point[] => {
    const { time, resolution } = result
    if (!time || resolution?.eps == null || result.outcome.name !== 'Completed') return []
    const { value, lo, hi } = time.median_ns
    const missed = result.verdicts.reduce((sum, { verdict, count: n }) => sum + (verdict === 'false_negative' ? n : 0), 0)
    const point = {
      name: result.name, rate: 1e9 / value, rates: [1e9 / hi, 1e9 / lo] as [number, number], digits: -Math.log10(resolution.eps),
      atLeast: !resolution.seen && result.wrong === 0, wrong: result.wrong, missed, n: result.n, frontier: false,
    }
    const digits = `${point.atLeast ? 'at least ' : ''}${point.digits.toFixed(1)} digits`
    const reading = `${significant(point.rate)} per second · ${digits}${point.wrong > 0 ? ` · ${count(point.wrong)} wrong` : ''}`
    return [{ ...point, reading, words: describe(point, result) }]
  })
  return all.map((point) => ({ ...point, frontier: all.every((other) => !beats(other, point)) }))
}

/** Faster and not less accurate, or as fast and more accurate. No wrong answer seen beats any number of digits. */
function beats(a: Point, b: Point): boolean {
  if (a === b) return false
  const accuracy = (p: Point) => (p.atLeast ? Infinity : p.digits)
  return a.rate >= b.rate && accuracy(a) >= accuracy(b) && (a.rate > b.rate || accuracy(a) > accuracy(b))
}

function describe(point: Omit<Point, 'words' | 'reading'>, result: AlgorithmResult): string {
  const speed = `${significant(point.rate)} questions per second (${significant(point.rates[0])} to ${significant(point.rates[1])})`
  const accuracy = point.atLeast ? `no wrong answer seen, at least ${point.digits.toFixed(1)} digits` : `${point.digits.toFixed(1)} digits`
  const wrong = point.wrong > 0 ? `, ${count(point.wrong)} of ${count(point.n)} answers wrong, ${count(point.missed)} of them missed collisions` : ''
  return `${point.name}: ${speed}, ${accuracy}${wrong}${result.class ? `; ${classWords(result.class)}` : ''}.`
}

/** Who is fastest without a wrong answer, and by how much. */
export function sentence(all: readonly Point[]): string {
  const [first, second] = all.filter(({ wrong, atLeast }) => wrong === 0 && atLeast).toSorted((a, b) => b.rate - a.rate)
  if (!first) return 'No algorithm came without a wrong answer.'
  const head = `Fastest with no wrong answer seen: ${first.name}`
  if (!second) return `${head}; no other one came without.`
  const overlap = first.rates[0] <= second.rates[1]
  return `${head}, ${significant(first.rate / second.rate)} times ${second.name}; the 95 % intervals ${overlap ? 'overlap, so the order is not decided' : 'do not overlap'}.`
}
