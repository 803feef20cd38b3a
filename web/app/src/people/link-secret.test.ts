import { describe, expect, it } from 'vitest'
import { secretOf } from './link-secret'

describe('the link of an invitation', () => {
  it('carries its secret behind #', () => {
    expect(secretOf('#invitation=0a1b', 'invitation')).toBe('0a1b')
    expect(secretOf('invitation=0a1b&more=1', 'invitation')).toBe('0a1b')
  })
  it('is none without one', () => {
    for (const hash of ['', '#', '#invitation', '#invitation=', '#invitation=%20', '#else=1']) expect(secretOf(hash, 'invitation')).toBeNull()
  })
  it('is not that of an address', () => {
    expect(secretOf('#confirm=0a1b', 'confirm')).toBe('0a1b')
    expect(secretOf('#confirm=0a1b', 'invitation')).toBeNull()
    expect(secretOf('#invitation=0a1b', 'confirm')).toBeNull()
  })
})
