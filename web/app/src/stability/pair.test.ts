import { describe, expect, test } from 'vitest'
import type { FailingCase } from '../api/types'
import { drawing, placed } from './pair'

const still = ['1', '0', '0', '0', '0', '1', '0', '0', '0', '0', '1', '0', '0', '0', '0', '1']
const obj = 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n'
const lifted = still.with(11, '2')
const repro = { a: obj, b: obj, pose_a: still, pose_b: lifted } as FailingCase

describe('the failing pair', () => {
  test('stands where its matrix says', () => {
    expect(placed(obj, lifted)).toEqual([[[0, 0, 2], [1, 0, 2], [0, 0, 3]]])
    expect(placed(obj, still.with(3, 'NaN'))).toEqual([])
  })

  test('fills its square, both objects told apart', () => {
    const drawn = drawing(repro, 0, 0, 100)
    expect(drawn.map(({ side }) => side).toSorted()).toEqual(['a', 'b'])
    const numbers = drawn.flatMap(({ points }) => points.split(/[ ,]/).map(Number))
    expect(Math.min(...numbers)).toBeGreaterThanOrEqual(0)
    expect(Math.max(...numbers)).toBeLessThanOrEqual(100)
    expect(Math.max(...numbers) - Math.min(...numbers)).toBeCloseTo(88, 0)
  })
})
