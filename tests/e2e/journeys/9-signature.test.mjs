// A developer registers a key; a plugin signed with it says so on its page, and one signed with another is refused.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { newKey } from '../minisign.mjs'
import { enter, visitor } from '../visitor.mjs'

const PASSWORD = 'a long enough password'

test('a signed plugin says so, and a foreign signature is refused', async (t) => {
  const password = process.env.OCB_E2E_CURATOR
  assert.ok(password, 'OCB_E2E_CURATOR must be the password of the account "curator"')
  const [developer, curator] = [await visitor(t), await visitor(t)]
  await enter(developer, 'grace', PASSWORD, true)
  await enter(curator, 'curator', password, false)
  const { id } = (await curator.api('/accounts')).find(({ name }) => name === 'grace')
  await curator.api(`/accounts/${id}/role`, { method: 'POST', data: { role: 'developer' } })

  // Anything but a key is refused with a sentence.
  const [own, foreign] = [newKey(), newKey()]
  await developer.go('/account')
  developer.expectRefusal('/account/signing-key')
  await developer.at('public-key').fill('my key')
  await developer.at('register-key').click()
  await developer.page.getByText('not a minisign public key').waitFor()
  await developer.at('public-key').fill(own.publicKey)
  await developer.at('register-key').click()
  const key = own.publicKey.trim().split('\n')[1]
  await developer.page.getByTestId('signing-key').getByText(key).waitFor()
  await developer.accessible('the account page with a key')
  await developer.picture('signing-key')

  // No plugin that could be loaded: what its signature is worth is found out before.
  const bytes = Buffer.from(`\x7fELF of ${key}`, 'latin1')
  await developer.go('/submit')
  developer.expectRefusal('/api/v1/plugins')
  await developer.at('plugin-file').setInputFiles({ name: 'signed.so', mimeType: 'application/octet-stream', buffer: bytes })
  const fields = { name: 'Signed', version: '1.0', authors: 'Grace', license: 'MIT' }
  for (const [field, text] of Object.entries(fields)) await developer.at(`manifest-${field}`).fill(text)
  const signature = (by) => ({ name: 'signed.so.minisig', mimeType: 'text/plain', buffer: Buffer.from(by.signed(bytes)) })
  await developer.at('signature-file').setInputFiles(signature(foreign))
  await developer.at('submit-plugin').click()
  await developer.at('submit-problem').getByText('does not match this file and your registered key').waitFor()
  await developer.accessible('a submission with a foreign signature')
  await developer.picture('signature-refused')
  await developer.at('signature-file').setInputFiles(signature(own))
  await developer.at('submit-plugin').click()
  await developer.page.waitForURL(/\/p\/[0-9a-f-]{36}/)
  await developer.page.getByText(`signed by the registered key ${key}`).waitFor()
  await developer.picture('signature')
})
