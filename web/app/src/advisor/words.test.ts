import { expect, test } from 'vitest'
import type { Advice, AdvicePoint } from '../api/types'
import { headline, interval, ofSide, pointName, settingText, shareText, sizeText, stagesText } from './words'

const levels = [8000, 4000, 2000].map((triangles) => ({ triangles, thickness: 0, deviation: 0 }))
const advice = { levels_a: levels, levels_b: levels, longest_side: 2, stages: [[2, 1]], triangles_before: 16_000, triangles_after: 6000 } as unknown as Advice

test('advice is told with what it saves, or that it saves nothing', () => {
  expect(headline(advice)).toBe('Sufficient: 2,000 + 4,000 instead of 16,000 triangles, 2.67 times fewer.')
  expect(headline({ ...advice, stages: [] })).toContain('less detail saves nothing')
  expect(stagesText(advice, [[2, 2], [1, 1]])).toBe('2,000 + 2,000, then 4,000 + 4,000')
})

test('numbers come with their intervals, shares with their counts', () => {
  expect(interval({ value: 3.456, lo: 3, hi: 4.1 })).toBe('3.46 [3, 4.1]')
  expect(shareText({ seen: 0, of: 300, lo: 0, hi: 0.01 })).toMatch(/^0 of 300 \(< 1\s%\)$/)
  expect(shareText({ seen: 3, of: 300, lo: 0, hi: 0.03 })).toMatch(/^3 of 300 \(1\s%\)$/)
  expect(shareText(null)).toBe('–')
  expect(ofSide(advice, 0.02)).toMatch(/^1\s%$/)
})

test('another method is named with its setting, and its size in what it consists of', () => {
  const spheres = { kind: 'inner_spheres', algorithm: 'inner-spheres:spheres=512', elements: 1024, unit: 'spheres', certified: false } as AdvicePoint
  expect(pointName(advice, spheres)).toBe('Inner spheres, inner-spheres:spheres=512 (uncertified)')
  expect(pointName({ ...advice, configurations: 400 }, { ...spheres, asked: 37 })).toContain('(uncertified; 37 of 400 queried)')
  expect(sizeText(spheres)).toBe('1,024 spheres')
  expect(settingText(spheres)).toBe('spheres=512')
  expect(settingText({ ...spheres, kind: 'single_precision', algorithm: 'parry-f32' })).toBe('f32')
  expect(settingText({ ...spheres, kind: 'boxes', algorithm: null })).toBe('')
})
