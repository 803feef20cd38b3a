import { describe, expect, it } from 'vitest'
import { cellText, matrix, MOST_OBJECTS, paint } from './matrix'
import { pair } from './sample'

describe('the matrix of pairs', () => {
  it('holds each pair once, with the object that stands first in the scene as the row', () => {
    const { rows, columns, cell, ends, remainder } = matrix([pair([4, 1], 600), pair([0, 4], 300), pair([0, 5], 100)], 'time')
    expect([rows, columns]).toEqual([[0, 1], [4, 5]])
    expect([cell(1, 4)?.value, cell(0, 4)?.value, cell(0, 5)?.value, cell(1, 5), cell(4, 1)]).toEqual([0.6, 0.3, 0.1, null, null])
    expect(ends).toEqual([0.1, 0.6])
    expect(remainder).toBeNull()
  })

  it('colours shares of time by their logarithm, at most three decades deep', () => {
    const three = matrix([pair([0, 1], 100), pair([0, 2], 10), pair([0, 3], 1)], 'time')
    expect([1, 2, 3].map((column) => three.cell(0, column)?.position)).toEqual([1, expect.closeTo(0.5, 9), 0])
    const deep = matrix([pair([0, 1], 1e9), pair([0, 2], 1), pair([0, 3], 0)], 'time')
    expect((deep.ends?.[0] ?? 0) / (deep.ends?.[1] ?? 1)).toBeCloseTo(1e-3, 9)
    expect([2, 3].map((column) => deep.cell(0, column)?.position)).toEqual([0, 0])
    expect([three.cut, deep.cut]).toEqual([false, true])
  })

  it('has a scale for one pair, for none, and for pairs without a time', () => {
    expect(matrix([pair([0, 1], 5)], 'time').cell(0, 1)?.position).toBe(1)
    expect(matrix([], 'time')).toMatchObject({ rows: [], columns: [], ends: null, remainder: null })
    const untimed = matrix([pair([0, 1], 0)], 'time')
    expect([untimed.ends, untimed.cell(0, 1)?.value]).toEqual([null, 0])
  })

  it('colours hits from 0 to all and wrong answers from 0 to the most', () => {
    const pairs = [{ ...pair([0, 1], 9), wrong: 8 }, { ...pair([0, 2], 1), wrong: 2 }]
    expect([matrix(pairs, 'hits').ends, matrix(pairs, 'hits').cell(0, 1)?.position]).toEqual([[0, 1], 0.5])
    expect([matrix(pairs, 'wrong').ends, matrix(pairs, 'wrong').cell(0, 2)?.position]).toEqual([[0, 8], 0.25])
    expect(matrix([pair([0, 1], 9)], 'wrong').cell(0, 1)?.position).toBe(0)
  })

  it('keeps the most expensive objects and states the remainder', () => {
    const many = Array.from({ length: 60 }, (_, i) => pair([0, i + 1], 60 - i))
    const { rows, columns, cell, remainder } = matrix(many, 'time')
    expect([rows, columns.length, columns.at(-1)]).toEqual([[0], MOST_OBJECTS - 1, MOST_OBJECTS - 1])
    expect(cell(0, MOST_OBJECTS)).toBeNull()
    const [all, rest] = [(60 * 61) / 2, (21 * 22) / 2]
    expect(remainder).toEqual({ objects: 21, pairs: 21, share: expect.closeTo(rest / all, 9) })
  })

  it('writes numbers that read on their colour', () => {
    const luminance = (hex: string) => (hex === '#000000' ? 0 : 1)
    for (let i = 0; i <= 20; i++) {
      const { background, color } = paint(i / 20)
      const parts = (background.match(/[\d.]+/g) ?? []).map((part) => { const l = Number(part) / 255; return l <= 0.04045 ? l / 12.92 : ((l + 0.055) / 1.055) ** 2.4 })
      const [r = 0, g = 0, b = 0] = parts
      const [lo = 0, hi = 0] = [0.2126 * r + 0.7152 * g + 0.0722 * b, luminance(color)].toSorted((x, y) => x - y)
      expect((hi + 0.05) / (lo + 0.05)).toBeGreaterThan(4.5)
    }
    expect([0, 0.004, 0.126, 1].map((share) => cellText(share, 'time'))).toEqual(['0', '<1', '13', '100'])
    expect([0, 999, 12_400].map((wrong) => cellText(wrong, 'wrong'))).toEqual(['0', '999', '12k'])
  })
})
