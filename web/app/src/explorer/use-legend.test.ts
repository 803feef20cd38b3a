import { describe, expect, it } from 'vitest'
import type { Heatmap } from '../api/types'
import { DEFAULTS } from './url-state'
import { failureWords, legendName, scaleKind } from './use-legend'

const map = (values: (number | null)[], unit = 'share'): Heatmap => ({
  request: { algorithm: 'a', side: 'a', measure: 'wrong', statistic: 'mean', outliers: 'keep' },
  unit, values, counts: values.map(() => 9), dropped: values.map(() => 0), n: 9, range: null, preliminary: false,
})

describe('the legend', () => {
  it('names failures as shares, and differences as such', () => {
    expect(legendName({ ...DEFAULTS, measure: 'wrong', statistic: 'max' })).toBe('Wrong answers, share')
    expect(legendName({ ...DEFAULTS, measure: 'distance_error', statistic: 'max' })).toBe('Maximum of distance error per query')
    expect(legendName({ ...DEFAULTS, against: 'b' })).toContain('difference')
  })

  it('knows what the colours have to show', () => {
    expect(scaleKind(DEFAULTS)).toBe('values')
    expect(scaleKind({ ...DEFAULTS, measure: 'flips' })).toBe('failures')
    expect(scaleKind({ ...DEFAULTS, measure: 'flips', against: 'b' })).toBe('differences')
    // Two algorithms of one run have the same density.
    expect(scaleKind({ ...DEFAULTS, measure: 'density', against: 'b' })).toBe('values')
  })

  it('says in words where failures are', () => {
    expect(failureWords('X', map([0, 0, null]))).toBe('X: 0 at all 2 vertices that have a value.')
    expect(failureWords('X', map([0, 0.25, 0.5, null]))).toBe('X: above 0 at 2 of 3 vertices, at most 50\u202f%.')
    expect(failureWords('X', map([null]))).toBe('X: no vertex has a value.')
  })
})
