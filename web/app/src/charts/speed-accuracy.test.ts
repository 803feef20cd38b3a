import { describe, expect, it } from 'vitest'
import type { AlgorithmResult } from '../api/types'
import { points, sentence } from './speed-accuracy'

function result(name: string, median: number, eps: number, more: { seen?: boolean; wrong?: number; missed?: number } = {}): AlgorithmResult {
  const time = { value: median, lo: 0.9 * median, hi: 1.1 * median }
  const { seen = false, wrong = 0, missed = 0 } = more
  const none = { n: 10, wrong: 0, at: null }
  return {
    algorithm: name, name, outcome: { name: 'Completed', message: '', ours: false }, n: 10, of: 10, budget_limited: false,
    time: { mean_ns: time, median_ns: time, p95_ns: time, max_ns: time, below_resolution: 0 }, verdicts: [{ verdict: 'false_negative', count: missed }], wrong,
    resolution: { eps, seen, false_hits: none, misses: none, distance: null }, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null,
  }
}

describe('speed against accuracy', () => {
  const exact = result('exact', 1000, 1e-12)
  const slow = result('slow', 4000, 1e-12)
  const rough = result('rough', 100, 1e-3, { seen: true, wrong: 4, missed: 3 })
  const bad = result('bad', 2000, 1e-2, { seen: true, wrong: 1 })

  it('draws the frontier through what nothing beats', () => {
    const found = points([slow, exact, rough, bad])
    expect(found.map(({ name, frontier }) => [name, frontier])).toEqual([['slow', false], ['exact', true], ['rough', true], ['bad', false]])
    const [, first, second] = found
    expect(first?.rate).toBeCloseTo(1e6)
    expect(first?.digits).toBeCloseTo(12)
    expect([first?.atLeast, second?.atLeast]).toEqual([true, false])
    expect(second?.words).toContain('4 of 10 answers wrong, 3 of them missed collisions')
  })

  it('leaves out what failed or was not measured', () => {
    expect(points([{ ...exact, time: null }, { ...exact, outcome: { name: 'TimedOut', message: '', ours: false } }])).toEqual([])
  })

  it('says in words who is fastest without a wrong answer', () => {
    expect(sentence(points([slow, rough, exact]))).toBe('Fastest with no wrong answer seen: exact, 4 times slow; the 95 % intervals do not overlap.')
    expect(sentence(points([exact, result('twin', 1050, 1e-12)]))).toContain('overlap, so the order is not decided')
    expect(sentence(points([rough]))).toBe('No algorithm came without a wrong answer.')
  })
})
