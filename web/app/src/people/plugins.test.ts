import { describe, expect, test } from 'vitest'
import { age, isAtLeast, steps } from './plugins'

const actions = (mine: boolean, state: Parameters<typeof steps>[0]['state'], role?: Parameters<typeof steps>[1]) =>
  steps({ mine, state }, role).map(({ action }) => action)

describe('steps', () => {
  test('the author offers, answers and withdraws', () => {
    expect(actions(true, 'validated', 'developer')).toEqual(['offer'])
    expect(actions(true, 'asked', 'developer')).toEqual(['answer'])
    expect(actions(true, 'public', 'developer')).toEqual(['withdraw'])
    expect(actions(true, 'failed', 'developer')).toEqual([])
  })
  test('author and curators end a check', () => {
    expect(actions(true, 'uploaded', 'developer')).toEqual(['end_check'])
    expect(actions(true, 'vetted', 'curator')).toEqual(['end_check'])
    expect(actions(false, 'vetted', 'administrator')).toEqual(['end_check'])
    expect(actions(false, 'vetted', 'developer')).toEqual([])
    expect(steps({ mine: false, state: 'uploaded' }, 'curator')[0]?.reason).toBeDefined()
  })
  test('curators decide, but not about their own', () => {
    expect(actions(false, 'awaiting', 'curator')).toEqual(['approve', 'ask', 'reject'])
    expect(actions(true, 'awaiting', 'curator')).toEqual([])
    expect(actions(false, 'awaiting', 'developer')).toEqual([])
    expect(actions(false, 'public')).toEqual([])
  })
})

test('roles are in an order', () => {
  expect(isAtLeast('administrator', 'curator')).toBe(true)
  expect(isAtLeast('user', 'developer')).toBe(false)
  expect(isAtLeast(undefined, 'user')).toBe(false)
})

test('ages read well', () => {
  const now = 1_000_000_000_000
  const before = (minutes: number) => age((now - minutes * 60_000) * 1000, now)
  expect([before(0), before(5), before(119), before(60 * 47), before(60 * 72)]).toEqual(
    ['just now', '5 min ago', '1 h ago', '47 h ago', '3 days ago'],
  )
})
