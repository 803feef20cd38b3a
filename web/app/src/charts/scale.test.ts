import { describe, expect, it } from 'vitest'
import type { Axis } from '../api/types'
import { label, placing } from './scale'

const axis = (scale: Axis['scale'], lane: string | null = null): Axis => ({ label: 'x', unit: '', scale, lane })

describe('places on an axis', () => {
  it('steps evenly by logarithm, with round ticks inside', () => {
    const x = placing(axis('log'), [1, 100])
    expect(x.at(10) - x.at(1)).toBeCloseTo(x.at(100) - x.at(10), 12)
    expect(x.ticks(3).map(({ text }) => text)).toEqual(['1', '10', '100'])
  })

  it('mirrors a signed axis about its middle', () => {
    const x = placing(axis('signed'), [-1e-2, -1e-8, 1e-8, 1e-2])
    expect(x.at(-1e-2) + x.at(1e-2)).toBeCloseTo(1, 12)
    expect(x.at(0)).toBeCloseTo(0.5, 12)
    expect(x.at(1e-2)).toBeGreaterThan(x.at(1e-8))
    expect(x.ticks(8).some(({ text }) => text.startsWith('-'))).toBe(true)
  })

  it('puts what has no value into the lane, before every value', () => {
    const x = placing(axis('log', 'none seen'), [1e-4, 1e-2])
    expect(x.at(null)).toBeLessThan(x.lane)
    expect(x.at(1e-4)).toBeGreaterThan(x.lane)
  })

  it('has finite places even without values', () => {
    for (const scale of ['linear', 'log', 'signed'] as const) {
      expect(Number.isFinite(placing(axis(scale), []).at(1))).toBe(true)
      expect(Number.isFinite(placing(axis(scale), [7]).at(7))).toBe(true)
    }
  })

  it('says numbers in their unit', () => {
    expect([label(0.01, 'share'), label(1e-5, 'share'), label(0, 'share'), label(20_000, '1/s'), label(2.5e6, '1/s')]).toEqual(['1 %', '1e-5', '0 %', '20 k', '2.5 M'])
    expect(label(1500, 'ns')).toBe('1.5\u202fµs')
  })
})
