import { describe, expect, it } from 'vitest'
import { whereMailsGo } from './choices'

describe('where mails go, in words', () => {
  const choices = { agrees_to_reruns: false, mail_notices: true, address: 'ada@example.org', confirmed: true, mailing: true }
  it('says so when they go', () => {
    expect(whereMailsGo(choices)).toBe('Notices go to ada@example.org.')
  })
  it('never promises a mail that does not go', () => {
    for (const less of [{ mailing: false }, { address: null, confirmed: false }, { confirmed: false }, { mail_notices: false }]) {
      expect(whereMailsGo({ ...choices, ...less })).not.toContain('Notices go to')
    }
    expect(whereMailsGo({ ...choices, mailing: false, confirmed: false })).toContain('sends no mails')
  })
})
