import { describe, expect, it } from 'vitest'
import type { AlgorithmResult } from '../api/types'
import { rank, rankings } from './ranking'

function result(algorithm: string, place: number | null, ratio: number, more: Partial<AlgorithmResult> = {}): AlgorithmResult {
  const estimated = { value: ratio, lo: 0.9 * ratio, hi: 1.1 * ratio }
  return {
    algorithm, name: algorithm, outcome: { name: 'Completed', message: 'Completed.', ours: false }, n: 10, of: 10, budget_limited: false,
    rank: place, ratio: estimated,
    time: { mean_ns: estimated, median_ns: estimated, p95_ns: estimated, max_ns: estimated, below_resolution: 0 },
    verdicts: [], wrong: 0, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null, preliminary: false, ...more,
  }
}

describe('rank', () => {
  it('takes the places of the service, ties by their value', () => {
    const { ranked } = rank([result('c', 3, 4), result('b', 1, 1.1), result('a', 1, 1)])
    expect(ranked.map((r) => [r.result.algorithm, r.rank, r.tied])).toEqual([['a', 1, true], ['b', 1, true], ['c', 3, false]])
  })

  it('gives no place to what failed, answered wrong or was not measured, and says why', () => {
    const crashed = result('crashed', null, 1, { outcome: { name: 'Signaled', message: 'It crashed.', ours: false } })
    const modest = result('modest', null, 1, { verdicts: [{ verdict: 'correct', count: 7 }, { verdict: 'gave_up', count: 2 }, { verdict: 'unsupported', count: 1 }] })
    const { ranked, unranked } = rank([modest, crashed, result('wrong', null, 2, { wrong: 1 }), result('silent', null, 3, { time: null }), result('old', null, 1), result('measured', null, 1, { preliminary: true }), result('guessing', null, 1, { unranked: { cause: 'wrong_controls', wrong: 9, n: 30, message: '9 of 30 control questions were answered wrongly.' } }), result('sound', 1, 4)])
    expect(ranked.map((r) => r.result.algorithm)).toEqual(['sound'])
    expect(unranked.map((r) => [r.result.algorithm, r.reason])).toEqual([
      ['modest', 'It did not answer 3 of 10 queries, so its time is not ranked.'],
      ['crashed', 'It crashed.'],
      ['wrong', 'It gave wrong answers, so its time is not ranked.'],
      ['silent', 'Nothing was measured.'],
      ['old', 'It was not compared with a reference: it was measured in the development profile, or by an older version.'],
      ['measured', 'Still being measured.'],
      ['guessing', '9 of 30 control questions were answered wrongly.'],
    ])
  })
})

it('lists what is still measured by its place so far, without giving it one', () => {
  const soFar = (algorithm: string, place?: number) => result(algorithm, null, 1, { preliminary: true, ...(place && { place_so_far: place }) })
  const { ranked, unranked } = rank([soFar('none'), soFar('second', 2), soFar('first', 1)])
  expect(ranked).toEqual([])
  expect(unranked.map((r) => r.result.algorithm)).toEqual(['first', 'second', 'none'])
})

it('compares only what had to deliver the same', () => {
  const alone = { delivered: 'distance', order: 'shuffled', cpus: 1, bits: 64 } as const
  const pair = { ...alone, delivered: 'distance_with_witness', cpus: 2, bits: 32 } as const
  const found = rankings([result('a', 2, 2, { class: alone }), result('b', 1, 9, { class: pair }), result('c', 1, 1, { class: alone })])
  expect(found.map(({ words, ranked }) => [words, ranked.map((r) => r.result.algorithm)])).toEqual([
    ['distance, shuffled, 1 CPU, f64', ['c', 'a']],
    ['distance with witness, shuffled, 2 CPUs, f32', ['b']],
  ])
})
