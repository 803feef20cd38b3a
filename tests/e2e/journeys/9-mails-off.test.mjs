// Somebody has notices mailed, and turns that off by the link in a mail, in a browser where nobody is logged in.
import assert from 'node:assert/strict'
import { spawn } from 'node:child_process'
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs'
import { connect } from 'node:net'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { freePort, root, startService } from '../service.mjs'
import { until, visitor } from '../visitor.mjs'

const listens = (port) => new Promise((done) => {
  const tried = connect(port, '127.0.0.1', () => { tried.destroy(); done(true) }).once('error', () => done(false))
})

test('the link in a mail turns mails off, once its button is pressed', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'ocb-mails-'))
  const port = await freePort()
  const program = [join(root, 'tests/setup/mail_server.py'), String(port), folder, 'well']
  const server = spawn(join(root, '.tools/smtp/bin/python'), program, { stdio: ['ignore', 'inherit', 'inherit'] })
  t.after(() => { server.kill(); rmSync(folder, { recursive: true, force: true }) })
  await until('the mail server to listen', () => listens(port))
  const service = await startService({ options: ['--smtp-url', `smtp://127.0.0.1:${port}`, '--mail-from', 'ocb@example.org'] })
  t.after(service.stop)
  const [ada, other] = [await visitor(t, { base: service.url }), await visitor(t, { base: service.url, scheme: 'dark' })]

  await ada.go('/account')
  await ada.at('account-switch').click()
  await ada.at('account-name').fill('ada')
  await ada.at('account-password').fill('a long enough password')
  await ada.at('account-enter').click()
  await ada.at('mail-notices').check()
  await ada.at('address').fill('ada@example.org')
  await ada.at('give-address').click()
  const [mail] = await until('the mail with its links', async () => {
    const all = readdirSync(folder).filter((name) => name.endsWith('.json'))
    return all.length > 0 && all.map((name) => JSON.parse(readFileSync(join(folder, name))))
  })
  const link = (what) => mail.text.match(new RegExp(`${service.url}/${what}\\S+`))[0]
  await ada.page.goto(link('account#confirm='))
  await ada.at('confirm-address').click()
  await ada.at('where-mails-go').getByText('Notices go to ada@example.org.').waitFor()

  const off = link('mails/off/')
  assert.equal(mail.head['list-unsubscribe'].trim(), `<${off}>`)
  const choices = () => ada.api('/account/choices')
  await other.page.goto(off)
  await other.at('mails-off').waitFor()
  await other.accessible('the page of a link that turns mails off')
  await other.picture('mails-off')
  assert.equal((await choices()).mail_notices, true, 'opening the link does nothing')
  await other.at('mails-off').click()
  await other.at('mails-are-off').waitFor()
  await other.accessible('mails that are off')
  assert.deepEqual(await choices(), { agrees_to_reruns: false, mail_notices: false, address: 'ada@example.org', confirmed: true, mailing: true })
  await ada.page.reload()
  await ada.at('where-mails-go').getByText('mails are off').waitFor()

  // A link of which a part was lost says so.
  other.expectRefusal('/mails/off/')
  await other.page.goto(off.slice(0, -1))
  await other.at('mails-off').click()
  await other.at('mails-off-problem').getByText('link is not valid').waitFor()
  await other.accessible('a link that turns nothing off')
})
