import { describe, expect, test } from 'vitest'
import type { FamilyInfo, FamilyResult, Stability, Tally } from '../api/types'
import { chartable, points, smallest } from './thresholds'

const tally: Tally = { agrees: 1, grazing: 0, misses: 0, false_alarms: 0, distances: 0, unsteady: 0, broken: 0, slow: 0, unsupported: 0, refused: 0 }
const step = (at: number, ns: number | null) => ({ at, tally, collision: ns === null ? null : { n: 4, median_ns: ns }, distance: null })
const method = (algorithm: string, fails: number | null, times: (number | null)[]): Stability => ({
  algorithm, name: algorithm, version: '1', plugin_sha256: '', single_precision: false, seeds: 1, created_us: 0, complete: true,
  families: [{ family: 'gap', state: 'agrees', tally, steps: times.map((ns, i) => step(10 ** (i - 9), ns)), thresholds: fails === null ? [] : [{ holds: null, fails }], first: null } satisfies FamilyResult],
  relations: [], failures: [], tessellations: [], search: null, unit_safe: null, offset_safe: null,
})
const methods = [method('a', 1e-7, [900, 1100, 1000, 1300]), method('b', null, [0.2, 0.3]), method('old', 1e-5, [null])]
const family = (id: string, harder: FamilyInfo['harder'], continuous: boolean): FamilyInfo => ({ id, name: id, sentence: '', source: '', parameter: 'gap', continuous, harder, beyond: false })

describe('thresholds against times', () => {
  test('each algorithm with times is a point', () => {
    expect(points(methods, 'gap', 'collision')).toEqual([
      { algorithm: 'a', name: 'a', fails: 1e-7, ns: 1050, range: [900, 1300], n: 16 },
      { algorithm: 'b', name: 'b', fails: null, ns: 1, range: [1, 1], n: 8 },
    ])
    expect(points(methods, 'gap', 'distance')).toEqual([])
    expect(smallest(methods, 'gap')).toBe(1e-9)
  })

  test('only sizes that get harder as they get smaller are drawn', () => {
    const families = [family('gap', 'small', true), family('large', 'large', true), family('steps', 'small', false), family('untimed', 'small', true)]
    expect(chartable({ families, methods }, 'collision').map(({ id }) => id)).toEqual(['gap'])
    expect(chartable({ families, methods }, 'distance')).toEqual([])
  })
})
