import { expect, test } from 'vitest'
import type { AlgorithmResult, SetInfo } from '../api/types'
import { roundingNote, roundingText } from './rounding'

test('an object says what single precision does to it', () => {
  expect(roundingText({ moves: 0.0312, collapsed: 0, flattens: false })).toContain('get them rounded: by up to 3.1e-2.')
  expect(roundingText({ moves: 0.0312, collapsed: 1, flattens: false })).toContain('by up to 3.1e-2, and 1 triangle loses its area.')
  expect(roundingText({ moves: 0.5, collapsed: 4, flattens: true })).toContain('cannot be measured on this object')
})

test('a run says who got rounded coordinates, and what that changes', () => {
  const results = [{ name: 'Box tree', rounded: false }, { name: 'parry f32', rounded: true }] as AlgorithmResult[]
  const set = { configurations: 400, rounding: { other_answers: 3, largest_change: 0.03125 } } as SetInfo
  const note = roundingNote(results, set)
  expect(note).toContain('parry f32 computes in single precision, got rounded coordinates and is judged by the truth about these.')
  expect(note).toContain('the answer to 3 of 400 configurations, and distances by up to 3.1e-2.')
  expect(roundingNote(results.slice(0, 1), set)).toBe('')
  expect(roundingNote(results, { configurations: 400 } as SetInfo)).toBe('')
  expect(roundingNote([...results, { name: 'x', rounded: true } as AlgorithmResult], set)).toContain('parry f32 and x compute in single precision, got rounded coordinates and are judged')
})
