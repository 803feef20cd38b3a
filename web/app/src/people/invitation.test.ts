import { describe, expect, it } from 'vitest'
import { secretOf } from './invitation'

describe('the link of an invitation', () => {
  it('carries its secret behind #', () => {
    expect(secretOf('#invitation=0a1b')).toBe('0a1b')
    expect(secretOf('invitation=0a1b&more=1')).toBe('0a1b')
  })
  it('is none without one', () => {
    for (const hash of ['', '#', '#invitation', '#invitation=', '#invitation=%20', '#else=1']) expect(secretOf(hash)).toBeNull()
  })
})
