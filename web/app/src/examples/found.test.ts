import { describe, expect, it } from 'vitest'
import type { Advice, AlgorithmResult } from '../api/types'
import { percent } from '../ui/format'
import { found, savedBy } from './found'

const result = (name: string, median: number, rank: number | null, wrong = 0) =>
  ({ name, rank, wrong, n: 2000, time: { median_ns: { value: median, lo: median * 0.9, hi: median * 1.1 } } }) as unknown as AlgorithmResult

describe('what an example found', () => {
  it('names the fastest right algorithm with its interval and n, and how much longer the slowest takes', () => {
    expect(found([result('slow', 3000, 2), result('fast', 1000, 1)])).toEqual(['fast takes 1\u202fµs at the median (0.9–1.1, n = 2,000), slow 3× as long.'])
  })
  it('never calls one that is wrong the fastest, and says how often it is wrong', () => {
    expect(found([result('wrong', 10, null, 7), result('right', 1000, 1)])).toEqual([
      'right takes 1\u202fµs at the median (0.9–1.1, n = 2,000).', 'wrong takes 10\u202fns (9–11) and is wrong in 7 of 2,000 configurations.',
    ])
    expect(found([])).toEqual([])
  })
})

it('says what less detail saves, how wrong it was, and that it saves nothing where it does not', () => {
  const share = (seen: number) => ({ seen, of: 1000, lo: 0, hi: 0.003 })
  const advice = {
    question: { kind: 'distance', tolerance: 0.02 }, longest_side: 2, configurations: 400, triangles_before: 4000, triangles_after: 100, stages: [[1, 1]],
    levels_a: [{ triangles: 2000 }, { triangles: 50 }], levels_b: [{ triangles: 2000 }, { triangles: 50 }],
    faster: { value: 3, lo: 2.5, hi: 3.5 }, held_out: { observed_error: 0.02, wrong: share(0) },
  } as unknown as Advice
  expect(savedBy(advice)).toEqual([
    'Sufficient: 50 + 50 instead of 4,000 triangles, 40 times fewer.',
    '3 [2.5, 3.5] times faster than the whole objects (n = 400).',
    `The largest error was ${percent(0.01)} of the longest side; wrong answers on other configurations: 0 of 1,000 (< ${percent(0.003)}).`,
  ])
  const nothing = savedBy({ ...advice, stages: [] })
  expect(nothing).toHaveLength(2)
  expect(nothing[0]).toContain('saves nothing here')
})
