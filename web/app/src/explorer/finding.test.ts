import { expect, it } from 'vitest'
import type { Heatmap } from '../api/types'
import { finding } from './finding'

const map = (values: (number | null)[], n = 20): Heatmap => ({
  request: { algorithm: 'a', side: 'a', measure: 'time', statistic: 'median', outliers: 'keep' },
  unit: 'ns', values, counts: values.map(() => n), dropped: values.map(() => 0), n: 1000, range: null, preliminary: false,
})

it('says how much more the slow part costs', () => {
  const values = Array.from({ length: 200 }, (_, i) => (i < 180 ? 1000 : 4000))
  expect(finding('Box tree', map(values))).toBe('The slowest 5\u202f% of the surface cost Box tree at least 4× its median.')
})

it('says so when there is no slow part', () => {
  expect(finding('Box tree', map(Array.from({ length: 200 }, () => 1000)))).toContain('nearly the same everywhere')
})

it('keeps silent about chance', () => {
  expect(finding('Box tree', map(Array.from({ length: 200 }, (_, i) => i + 1), 3))).toBeNull()
  expect(finding('Box tree', map([1, 2, null]))).toBeNull()
})
