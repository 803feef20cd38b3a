import type { AlgorithmResult, InUnit } from '../api/types'
import { count } from '../ui/format'

/** How the numbers of the file were changed, as people write it. */
export function coordinates(exponent: number): string {
  const size = 2 ** Math.abs(exponent)
  if (exponent === 0) return 'as in the file'
  return exponent < 0 ? `times 1/${size}` : `times ${size}`
}

/** Wrong answers of all in one unit; nothing is said about none at all. */
export function wrongIn({ wrong, missed, answers }: InUnit): string {
  if (answers === 0) return '–'
  const all = `${count(wrong)} of ${count(answers)}`
  return missed > 0 ? `${all}, ${count(missed)} missed` : all
}

/** Answers are wrong in other units of length, and none in the unit of the files. */
export function onlyElsewhere({ wrong, by_unit: units = [] }: AlgorithmResult): boolean {
  return wrong > 0 && units.some((unit) => unit.exponent === 0 && unit.wrong === 0)
}

/** Where the stability lab asks the same in many more units. */
export function labOf(algorithm: string) {
  return { path: '/stability', query: { view: 'relations', method: algorithm, part: 'unit' } }
}
