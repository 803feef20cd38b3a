import { describe, expect, it } from 'vitest'
import { ecdfAxes, ecdfPath, preliminaryWords, timeAtShare, timeTicks } from './ecdf'

const box = { left: 40, right: 240, top: 0, bottom: 100 }
const curve = { algorithm: 'a', n: 3, time_ns: [10, 100, 1000], share: [0.25, 0.5, 1], preliminary: false }

describe('ecdfPath', () => {
  it('is a staircase that rises at each time, from 0 to 1', () => {
    const axes = ecdfAxes([curve], box)
    axes.x.domain([10, 1000])
    // Straight up at 10, level to 100, up, level to 1000, up: x moves first, then y.
    expect(ecdfPath(curve, axes)).toBe('M40,100L40,100L40,75L140,75L140,50L240,50L240,0')
  })

  it('has nothing to draw without times', () => {
    const empty = { algorithm: 'a', n: 0, time_ns: [], share: [], preliminary: false }
    expect(ecdfPath(empty, ecdfAxes([empty], box))).toBe('')
  })

  it('leaves out what a logarithmic axis has no place for', () => {
    const zero = { algorithm: 'a', n: 2, time_ns: [0, 10], share: [0.5, 1], preliminary: false }
    expect(ecdfPath(zero, ecdfAxes([zero], box))).not.toMatch(/NaN|Infinity/)
  })
})

it('holds all curves on one axis', () => {
  const { x } = ecdfAxes([curve, { ...curve, time_ns: [1, 2, 5e6] }], box)
  const [lo = 0, hi = 0] = x.domain()
  expect(lo).toBeLessThan(1)
  expect(hi).toBeGreaterThan(5e6)
})

it('reads quantiles', () => {
  expect(timeAtShare(curve, 0.5)).toBe(100)
  expect(timeAtShare(curve, 0.51)).toBe(1000)
  expect(timeAtShare({ ...curve, time_ns: [], share: [] }, 0.5)).toBeNull()
})

it('labels the axis at round times', () => {
  expect(timeTicks(ecdfAxes([curve], box))).toEqual([10, 20, 50, 100, 200, 500, 1000])
})

it('tells of preliminary curves the numbers of answers, and the band of the smallest', () => {
  const so_far = (n: number) => ({ ...curve, n, preliminary: true })
  expect(preliminaryWords([curve])).toBeNull()
  expect(preliminaryWords([curve, so_far(300), so_far(5000)])).toBe('preliminary, n = 300 to 5,000, shares ± 7.8 % (95 %)')
})
