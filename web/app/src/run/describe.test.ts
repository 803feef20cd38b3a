import { expect, test } from 'vitest'
import type { Stage } from '../api/types'
import { secondsLeft } from './describe'

const lane = (state: Stage['state'], seconds_left: number | null): Stage => ({
  kind: 'measuring', algorithm: 'a', state, done: 1, total: 10, rate: 1, seconds_left, message: null,
})

test('lanes take turns, so the time left is the sum of theirs', () => {
  expect(secondsLeft([lane('running', 20), lane('running', 30), lane('running', null), lane('done', 99)])).toBe(50)
  expect(secondsLeft([lane('running', null), lane('queued', 5)])).toBeNull()
})
