import { describe, expect, it } from 'vitest'
import { goesInWords, staysInWords } from './account-deletion'

describe('the deletion of an account in words', () => {
  const none = { runs: 0, objects: 0, configurations: 0, advice: 0, stability: 0, workloads: 0, plugins: 0 }
  it('says what goes, things or not', () => {
    expect(goesInWords({ goes: none })).toBe('This permanently deletes your password, sessions, tokens, address, choices and notices.')
    expect(goesInWords({ goes: { ...none, runs: 2, advice: 1, plugins: 1 } })).toMatch(/^This permanently deletes 2 runs, 1 piece of advice and 1 plugin, and your password/)
  })
  it('says what stays, and how to have something stay', () => {
    expect(staysInWords({ stays: { ...none, runs: 2 } })).not.toContain('plugin')
    expect(staysInWords({ stays: none })).toContain('make it public first')
    expect(staysInWords({ stays: { ...none, runs: 1, plugins: 2 } })).toMatch(/^1 run and 2 plugins will stay, without your name: public items may be cited\. A plugin keeps the manifest/)
  })
})
