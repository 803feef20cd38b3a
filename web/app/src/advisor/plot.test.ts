import { expect, test } from 'vitest'
import type { Advice, AdvicePoint } from '../api/types'
import { FAMILIES, PANEL, plot, shape } from './plot'

const measured = (value: number) => ({ value, lo: value * 0.9, hi: value * 1.1 })
const point = (kind: AdvicePoint['kind'], elements: number, more: Partial<AdvicePoint> = {}): AdvicePoint => ({
  kind, elements, unit: 'triangles', stages: [], micros: measured(10), faster: measured(1), certified: false, advised: false, ...more,
})
const levels = [{ triangles: 4000, thickness: 0, deviation: 0 }]
const advice = (question: Advice['question'], points: AdvicePoint[]) =>
  ({ question, points, longest_side: 2, levels_a: levels, levels_b: levels }) as unknown as Advice

test('families differ in their shapes alone', () => {
  expect(new Set(FAMILIES.map(shape)).size).toBe(FAMILIES.length)
  expect(new Set(FAMILIES.map(({ style }) => style.marker)).size).toBe(FAMILIES.length)
})

test('of a distance the errors are drawn, guaranteed filled and observed hollow', () => {
  const points = [
    point('whole', 8000, { guaranteed_error: 0 }),
    point('levels', 1000, { guaranteed_error: 0.02, observed_error: 0.002 }),
    point('inner_spheres', 8192, { unit: 'spheres', algorithm: 'inner-spheres:spheres=4096', observed_error: 0.2 }),
    point('voxels', 900, { unit: 'voxels', algorithm: 'voxmap-pointshell:voxel=0.01', false_alarms: { seen: 3, of: 30, lo: 0.03, hi: 0.3 } }),
  ]
  const { marks: [whole, level, spheres, voxels], panels } = plot(advice({ kind: 'distance', tolerance: 0.02 }, points), 50, 600)
  expect(whole?.spots).toEqual([])
  expect(level?.spots.map(({ hollow }) => hollow)).toEqual([false, true])
  expect(level?.spots[0]?.y).toBeLessThan(level?.spots[1]?.y ?? 0)
  expect(spheres?.spots[0]?.y).toBeLessThan(level?.spots[0]?.y ?? 0)
  expect(spheres?.setting).toBe('spheres=4096')
  expect(spheres?.words).toMatch(/8,192 spheres, .* µs, error observed 10\s%/)
  expect(voxels?.spots).toEqual([])
  expect(voxels?.words).toContain('false alarms 3 of 30')
  expect(panels.map(({ top }) => top)).toEqual([0, PANEL.height])
})

test('of a yes or no both kinds of wrong answers are drawn with their intervals', () => {
  const share = (seen: number, of: number) => ({ seen, of, lo: seen / of / 2, hi: Math.min(1, (seen + 1) / of) })
  const points = [
    point('same_question', 8000),
    point('boxes', 24, { false_alarms: share(50, 100), missed: share(0, 40) }),
    point('convex_parts', 500, { algorithm: 'convex-parts:depth=5', false_alarms: share(5, 100), missed: share(0, 0) }),
  ]
  const { marks: [same, boxes, parts], lines } = plot(advice({ kind: 'clearance', clearance: 0.1 }, points), 50, 600)
  expect(same?.spots).toEqual([])
  const [alarms, missed] = boxes?.spots ?? []
  expect(alarms?.hollow).toBe(false)
  expect(missed?.hollow).toBe(true)
  expect(alarms?.y).toBeLessThan(missed?.y ?? 0)
  expect(alarms?.from).toBeGreaterThan(alarms?.to ?? 0)
  expect(parts?.spots).toHaveLength(1)
  expect(parts?.x).toBeGreaterThan(boxes?.x ?? 0)
  expect(lines.every(({ path }) => !path.includes('NaN'))).toBe(true)
})
