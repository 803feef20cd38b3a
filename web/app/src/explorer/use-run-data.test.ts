import { expect, test } from 'vitest'
import type { AlgorithmResult, RunInfo } from '../api/types'
import { isPreliminary, preliminaryN, renewed } from './use-run-data'

const result = (algorithm: string, n: number, preliminary: boolean) => ({ algorithm, name: algorithm, n, preliminary }) as AlgorithmResult

test('what was preliminary is fetched anew when there is more of it, and nothing else', () => {
  const [a, b, final] = [result('a', 300, true), result('b', 300, true), result('c', 900, false)]
  expect(renewed([a, b, final], [a, b, final])).toEqual([])
  expect(renewed([a, b, final], [a, result('b', 900, false), { ...final }])).toEqual(['b'])
  expect(renewed([a, b], [b])).toEqual([])
})

test('a run is preliminary as long as one algorithm is, and says of how many answers', () => {
  const run = (...results: AlgorithmResult[]) => ({ results }) as unknown as RunInfo
  expect(isPreliminary(run(result('a', 900, false), result('b', 0, true)))).toBe(false)
  const going = run(result('a', 5000, false), result('b', 300, true))
  expect([isPreliminary(going), preliminaryN(going)]).toEqual([true, '300 to 5,000'])
  expect(preliminaryN(run(result('a', 300, true)))).toBe('300')
})
