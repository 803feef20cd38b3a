import { describe, expect, it } from 'vitest'
import { bytes, count, estimated, inOneUnit, percent, seconds, significant, time, value, wrongAnswers } from './format'

/** The narrow no-break space reads as an ordinary one here. */
const plain = (text: string) => text.replaceAll('\u202f', ' ')

describe('significant', () => {
  it.each([[0, '0'], [0.012345, '0.0123'], [1.2345, '1.23'], [999.6, '1,000'], [12_345.6, '12,346'], [-3.456, '-3.46']])('%d', (n, text) =>
    expect(significant(n)).toBe(text),
  )
})

it.each([[0.4, '0.4 ns'], [999, '999 ns'], [1000, '1 µs'], [12_345, '12.3 µs'], [4.2e7, '42 ms'], [3.1e9, '3.1 s']])('time %d', (ns, text) =>
  expect(plain(time(ns))).toBe(text),
)

it('keeps an estimate and its interval in one unit', () => {
  const { value: v, interval } = estimated({ value: 1012, lo: 985, hi: 1040 })
  expect(plain(v)).toBe('1.01 µs')
  expect(interval).toBe('0.985–1.04')
})

it('chooses one unit for a whole axis', () => {
  expect(inOneUnit([10_000, 20_000, 50_000], 'ns')).toEqual({ unit: 'µs', texts: ['10', '20', '50'] })
  expect(inOneUnit([1e4, 1e6, 1e9], 'ns')).toEqual({ unit: 'ms', texts: ['0.01', '1', '1,000'] })
  expect(inOneUnit([1, 20], 'tests')).toEqual({ unit: 'tests', texts: ['1', '20'] })
  expect(inOneUnit([0], 'ns').texts).toEqual(['0'])
})

it('says values with their unit', () => {
  expect(plain(value(2.5, 'tests'))).toBe('2.5 tests')
  expect(plain(value(12_345, 'configurations'))).toBe('12,345 configurations')
  expect(plain(value(1, 'configurations'))).toBe('1 configuration')
  expect(plain(value(2500, 'ns'))).toBe('2.5 µs')
})

it('says waiting times as a person would', () => {
  expect([0.3, 42.2, 600, 9000].map((s) => plain(seconds(s)))).toEqual(['under 1 s', '42 s', '10 min', '2.5 h'])
})

it('says the rest', () => {
  expect(count(1_234_567)).toBe('1,234,567')
  expect(plain(bytes(19_300_000))).toBe('18.4 MiB')
  expect(plain(percent(0.2315))).toBe('23.2 %')
  expect([wrongAnswers(0, 100), wrongAnswers(3, 1000), wrongAnswers(0, 0)]).toEqual(['none in 100', '3 in 1,000', 'nothing answered'])
})
