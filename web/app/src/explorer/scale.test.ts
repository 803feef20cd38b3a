import { describe, expect, it } from 'vitest'
import { histogram, position, quantile, sharedScale, sortedValues, valueAt } from './scale'

describe('position', () => {
  it('is linear between the ends and stays inside', () => {
    const scale = { log: false, lo: 10, hi: 20 }
    expect([5, 10, 12.5, 20, 99].map((v) => position(scale, v))).toEqual([0, 0, 0.25, 1, 1])
  })

  it('gives each decade the same length on a logarithmic scale', () => {
    const scale = { log: true, lo: 1, hi: 1e4 }
    for (const [value, at] of [[1, 0], [10, 0.25], [100, 0.5], [1e4, 1]] as const) expect(position(scale, value)).toBeCloseTo(at, 12)
    expect(position(scale, 0)).toBe(0)
  })

  it.each([true, false])('is undone by valueAt (log %s)', (log) => {
    const scale = { log, lo: 3, hi: 4700 }
    for (const value of [3, 17, 900, 4700]) expect(valueAt(scale, position(scale, value))).toBeCloseTo(value, 8)
  })
})

describe('sharedScale', () => {
  const many = sortedValues([Array.from({ length: 101 }, (_, i) => i), [null, null]])

  it('is one range over all maps, without the vertices that have no value', () => {
    const sorted = sortedValues([[3, null, 1], [null, 9, 2]])
    expect([...sorted]).toEqual([1, 2, 3, 9])
    expect(sharedScale(sorted, false, 'full')).toEqual({ log: false, lo: 1, hi: 9 })
  })

  it('leaves two per cent out at each end unless all are wanted', () => {
    expect(sharedScale(many, false, 'p2-98')).toEqual({ log: false, lo: 2, hi: 98 })
    expect(sharedScale(many, false, 'full')).toEqual({ log: false, lo: 0, hi: 100 })
  })

  it('begins a logarithmic scale at the smallest positive value', () => {
    expect(sharedScale(many, true, 'full')).toEqual({ log: true, lo: 1, hi: 100 })
  })

  it('falls back to linear without a positive value, and to nothing without any', () => {
    expect(sharedScale(sortedValues([[0, 0]]), true, 'full')?.log).toBe(false)
    expect(sharedScale(sortedValues([[null]]), true, 'full')).toBeNull()
  })

  it.each([true, false])('never has equal ends (log %s)', (log) => {
    const scale = sharedScale(sortedValues([[5, 5, 5]]), log, 'full')
    expect(scale && position(scale, 5)).toBeCloseTo(0.5, 9)
  })
})

it('counts every value once in the histogram', () => {
  const sorted = sortedValues([[1, 2, 3, 4, 100]])
  expect(histogram(sorted, { log: false, lo: 1, hi: 4 }, 3)).toEqual([1, 1, 3])
})

it('interpolates quantiles', () => {
  expect(quantile(Float64Array.of(1, 2, 4), 0.75)).toBe(3)
})

describe('scales of failures and differences', () => {
  const values = (...all: number[]) => Float64Array.from(all)

  it('begins at 0, so that 0 is drawn as 0, and ends at the largest failure however rare it is', () => {
    expect(sharedScale(values(0, 0, 0, 0.25), false, 'p2-98', 'failures')).toEqual({ log: false, lo: 0, hi: 0.25 })
    expect(sharedScale(values(0, 0), true, 'p2-98', 'failures')).toEqual({ log: false, lo: 0, hi: 1 })
    expect(sharedScale(values(0, 1, 1e13), true, 'p2-98', 'failures')).toEqual({ log: true, lo: 1, hi: 1e13 })
  })

  it('has 0 in the middle of differences', () => {
    expect(sharedScale(values(-1, 0, 3), true, 'full', 'differences')).toEqual({ log: false, lo: -3, hi: 3 })
    expect(sharedScale(values(0, 0), true, 'p2-98', 'differences')).toEqual({ log: false, lo: -1, hi: 1 })
    const rare = Float64Array.from([...Array.from({ length: 200 }, () => 0), 5])
    expect(sharedScale(rare, false, 'p2-98', 'differences')).toEqual({ log: false, lo: -5, hi: 5 })
  })
})
