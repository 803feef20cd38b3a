import { describe, expect, it } from 'vitest'
import type { AlgorithmResult } from '../api/types'
import { rank } from './ranking'

function result(algorithm: string, median: number, spread: number, more: Partial<AlgorithmResult> = {}): AlgorithmResult {
  const estimated = { value: median, lo: median - spread, hi: median + spread }
  return {
    algorithm, name: algorithm, outcome: { name: 'Completed', message: 'Completed.', ours: false }, n: 10, of: 10, budget_limited: false,
    time: { mean_ns: estimated, median_ns: estimated, p95_ns: estimated, max_ns: estimated, below_resolution: 0 },
    verdicts: [], wrong: 0, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null, ...more,
  }
}

describe('rank', () => {
  it('goes by the median', () => {
    expect(rank([result('slow', 90, 1), result('fast', 10, 1)]).ranked.map((r) => [r.result.algorithm, r.rank, r.tied])).toEqual([
      ['fast', 1, false],
      ['slow', 2, false],
    ])
  })

  it('shares a place where intervals overlap, and counts on after it', () => {
    const { ranked } = rank([result('c', 40, 1), result('b', 11, 2), result('a', 10, 2)])
    expect(ranked.map((r) => [r.result.algorithm, r.rank, r.tied])).toEqual([['a', 1, true], ['b', 1, true], ['c', 3, false]])
  })

  it('gives no place to what failed, answered wrong or was not measured, and says why', () => {
    const crashed = result('crashed', 1, 0, { outcome: { name: 'Signaled', message: 'It crashed.', ours: false } })
    const modest = result('modest', 0.5, 0, { verdicts: [{ verdict: 'correct', count: 7 }, { verdict: 'gave_up', count: 2 }, { verdict: 'unsupported', count: 1 }] })
    const { ranked, unranked } = rank([modest, crashed, result('wrong', 2, 0, { wrong: 1 }), result('silent', 3, 0, { time: null }), result('sound', 4, 0)])
    expect(ranked.map((r) => r.result.algorithm)).toEqual(['sound'])
    expect(unranked.map((r) => [r.result.algorithm, r.reason])).toEqual([
      ['modest', 'It gave no answer to 3 of 10: giving up is not wrong, but it is not as fast as it looks.'],
      ['crashed', 'It crashed.'],
      ['wrong', 'It gave wrong answers: a time for a wrong answer is no result.'],
      ['silent', 'Nothing was measured.'],
    ])
  })
})
