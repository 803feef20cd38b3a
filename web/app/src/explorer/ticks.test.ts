import { describe, expect, it } from 'vitest'
import { legendTicks, logTicks } from './ticks'

const values = (log: boolean, lo: number, hi: number, limit?: number) => legendTicks({ log, lo, hi }, limit).map(({ value }) => value)

describe('legendTicks', () => {
  it('are round on a linear scale', () => {
    expect(values(false, 0, 10)).toEqual([0, 2, 4, 6, 8, 10])
  })

  it('take 1-2-5 over one decade, 1-3 over three, decades over five', () => {
    expect(values(true, 1, 10)).toEqual([1, 2, 5, 10])
    expect(values(true, 1, 900)).toEqual([1, 3, 10, 30, 100, 300])
    expect(values(true, 1, 1e5)).toEqual([1, 10, 100, 1000, 1e4, 1e5])
  })

  it('skip decades when there are too many', () => {
    expect(values(true, 1, 1e12).length).toBeLessThanOrEqual(6)
  })

  it('are still at least two in a narrow range', () => {
    expect(values(true, 101, 119).length).toBeGreaterThanOrEqual(2)
    expect(values(true, 1.9e7, 1.4e8)).toEqual([2e7, 5e7, 1e8])
  })

  it('lie inside the scale, ascending, where the colour of their value is', () => {
    const ticks = legendTicks({ log: true, lo: 7, hi: 70_000 })
    expect(ticks.every(({ at }) => at >= 0 && at <= 1)).toBe(true)
    expect(ticks.map(({ at }) => at)).toEqual(ticks.map(({ at }) => at).toSorted((a, b) => a - b))
    expect(ticks.find(({ value }) => value === 100)?.at).toBeCloseTo(Math.log(100 / 7) / Math.log(1e4), 9)
  })

  it('have no rounding dirt', () => {
    expect(logTicks(0.001, 0.03, 8)).toEqual([0.001, 0.002, 0.005, 0.01, 0.02])
  })
})
