import { describe, expect, it } from 'vitest'
import { thinned, within } from './density'

/** The same numbers in every run. */
function numbers(n: number): Float32Array {
  let seed = 1
  return Float32Array.from({ length: n }, () => (seed = (seed * 16807) % 2147483647) / 2147483647)
}
const oneByOne = (points: Float32Array, radius: number) =>
  Array.from({ length: points.length / 3 }, (_, i) => {
    let count = 0
    for (let k = 0; k < points.length; k += 3) {
      const [dx, dy, dz] = [0, 1, 2].map((j) => (points[k + j] ?? 0) - (points[3 * i + j] ?? 0)) as [number, number, number]
      if (dx * dx + dy * dy + dz * dz <= radius * radius) count++
    }
    return count
  })

describe('the density of closest points', () => {
  it.each([0.05, 0.2, 3])('is what counting one by one gives, radius %f', (radius) => {
    // Half of them in a corner, so that whole cells count.
    const points = numbers(1200).map((value, i) => (i < 600 ? value * 0.06 : value * 2 - 1))
    expect([...within(points, radius)]).toEqual(oneByOne(points, radius))
  })

  it('counts a point itself, and equal points', () => {
    expect([...within(new Float32Array([0, 0, 0, 0, 0, 0, 1, 0, 0]), 0.1)]).toEqual([2, 2, 1])
    expect(within(new Float32Array(0), 0.1)).toHaveLength(0)
  })

  it('leaves out configurations without a point, and thins what is too much', () => {
    const x = [0, Number.NaN, 2, 3, 4]
    expect(thinned(x, x, x)).toEqual({ positions: new Float32Array([0, 0, 0, 2, 2, 2, 3, 3, 3, 4, 4, 4]), records: new Uint32Array([0, 2, 3, 4]), of: 4 })
    expect(thinned(x, x, x, 2)).toMatchObject({ records: new Uint32Array([0, 3]), of: 4 })
  })
})
