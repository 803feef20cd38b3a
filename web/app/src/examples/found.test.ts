import { describe, expect, it } from 'vitest'
import type { AlgorithmResult } from '../api/types'
import { found } from './found'

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
