import { describe, expect, it } from 'vitest'
import type { AlgorithmResult } from '../api/types'
import { epsilon, resolutionNotes } from './resolution'

type Resolution = NonNullable<AlgorithmResult['resolution']>

function result(resolution: Resolution | null, more: Partial<AlgorithmResult> = {}): AlgorithmResult {
  return {
    algorithm: 'a', name: 'A', outcome: { name: 'Completed', message: 'Completed.', ours: false }, n: 10, of: 10, budget_limited: false,
    time: null, verdicts: [], wrong: 0, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null, preliminary: false, resolution, ...more,
  }
}

const SOUND: Resolution = { eps: 1.26e-8, seen: false, false_hits: { n: 6, wrong: 0, at: 1.26e-8 }, misses: { n: 4, wrong: 0, at: 1e-9 } }

describe('eps*', () => {
  it('is a value where errors were seen, a bound where none was, and nothing where nothing was tried', () => {
    expect(epsilon(result({ ...SOUND, eps: 0.0021, seen: true }))).toBe('2.1e-3')
    expect(epsilon(result(SOUND))).toBe('< 1.3e-8')
    expect(epsilon(result({ ...SOUND, eps: null }))).toBe('–')
    expect(epsilon(result(null))).toBe('–')
  })

  it('is explained', () => {
    expect(resolutionNotes(result(SOUND))).toEqual([])
    const off = { ...SOUND, seen: true, false_hits: { n: 6, wrong: 2, at: 1e-3 }, misses: { n: 4, wrong: 1, at: 1e-3 }, distance: { n: 10, over: 2.5 } }
    const notes = resolutionNotes(result(off, { grazing: { n: 3, agree: 2 }, contacts: { precision: 1, listed: 9, recall: null, robust: 0 } }))
    expect(notes).toEqual([
      'reports a hit for 2 of 6 apart',
      'misses 1 of 4 crossing',
      'distances too long by: 2.5 u S, too short by: none',
      'grazing: 2 of 3 agree with exact arithmetic',
      'contacts: precision 100\u202f%, recall –',
    ])
  })
})
