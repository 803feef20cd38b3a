import { expect, it } from 'vitest'
import type { AlgorithmResult, InUnit } from '../api/types'
import { coordinates, onlyElsewhere, wrongIn } from './units'

const unit = (exponent: number, wrong: number, missed = 0): InUnit => ({ exponent, processes: 2, n: 9, mean_ns: null, pace: null, answers: 1800, wrong, missed })
const result = (wrong: number, units: InUnit[]) => ({ wrong, by_unit: units }) as AlgorithmResult

it('says what was done to the numbers of the file', () => {
  expect([-3, 0, 3].map(coordinates)).toEqual(['times 1/8', 'as in the file', 'times 8'])
})

it('counts wrong answers of all, and none of none', () => {
  expect(wrongIn(unit(-3, 7, 5))).toBe('7 of 1,800, 5 missed')
  expect(wrongIn(unit(-3, 0))).toBe('0 of 1,800')
  expect(wrongIn({ ...unit(-3, 0), answers: 0 })).toBe('–')
})

it('tells wrong answers of other units from those of the file', () => {
  expect(onlyElsewhere(result(7, [unit(0, 0), unit(-3, 7)]))).toBe(true)
  expect(onlyElsewhere(result(7, [unit(0, 1), unit(-3, 7)]))).toBe(false)
  expect(onlyElsewhere(result(0, [unit(0, 0), unit(-3, 0)]))).toBe(false)
  expect(onlyElsewhere({ wrong: 7 } as AlgorithmResult)).toBe(false)
})
