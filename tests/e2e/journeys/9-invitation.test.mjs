// A curator invites a developer by a link, who makes an account and accepts; and a run is cited and taken along.
import assert from 'node:assert/strict'
import { readFile } from 'node:fs/promises'
import { test } from 'node:test'
import { until, url, visitor } from '../visitor.mjs'

test('somebody who is invited becomes a developer, once', async (t) => {
  const password = process.env.OCB_E2E_CURATOR
  assert.ok(password, 'OCB_E2E_CURATOR must be the password of the account "curator"')
  const [curator, guest] = [await visitor(t, { scheme: 'dark' }), await visitor(t)]
  await curator.go('/account')
  await curator.at('account-name').fill('curator')
  await curator.at('account-password').fill(password)
  await curator.at('account-enter').click()
  await curator.at('account-who').waitFor()
  await curator.go('/curate')
  await curator.at('invitation-for').fill('Ada, of the GJK paper')
  await curator.at('invite').click()
  const link = (await curator.at('invitation-link').textContent()).trim()
  assert.ok(link.startsWith(`${url}/account#invitation=`), link)
  await curator.at('invitation').filter({ hasText: 'Ada, of the GJK paper' }).waitFor()
  await curator.accessible('the page of curators with an invitation')
  await curator.picture('invitation-made')

  await guest.page.goto(link)
  await guest.at('invited').waitFor()
  await guest.accessible('the account page of somebody invited')
  await guest.at('account-switch').click()
  await guest.at('account-name').fill('ada-invited')
  await guest.at('account-password').fill('a long enough password')
  await guest.at('account-enter').click()
  await guest.at('accept-invitation').waitFor()
  await guest.accessible('an invitation that is to be accepted')
  await guest.picture('invitation-accept')
  await guest.at('accept-invitation').click()
  await guest.at('account-who').getByText('ada-invited · developer').waitFor()
  assert.equal(new URL(guest.page.url()).hash, '')
  await curator.go('/curate')
  await curator.at('invitation').getByText('accepted by ada-invited').waitFor()
})

test('a run is cited and taken along', async (t) => {
  const guest = await visitor(t)
  const spec = {
    object_a: 'stock:torus-knot@600', query: 'proximity', passes: 1, algorithms: ['box-tree'], separation: { kind: 'relative', distance: 0.1 },
    method: { kind: 'sphere', sampling: { kind: 'count', count: 60 } },
  }
  await guest.go('/runs')
  const { id } = await guest.api('/runs', { method: 'POST', data: spec })
  await until('the run is done', async () => (await guest.api(`/runs/${id}`)).state === 'done')
  await guest.go(`/r/${id}`)
  await guest.at('cite').locator('summary').click()
  await guest.at('cite-bibtex').getByText(`@misc{opencollbench-run-${id},`).waitFor()
  assert.equal((await guest.at('cite-link').textContent()).trim(), `${url}/r/${id}`)
  assert.match(await guest.at('cite-cff').textContent(), /cff-version: 1\.2\.0/)
  await guest.accessible('a run that is cited')
  await guest.at('cite').scrollIntoViewIfNeeded()
  await guest.picture('cite')
  const [download] = await Promise.all([guest.page.waitForEvent('download'), guest.at('download-repro').click()])
  const archive = await readFile(await download.path())
  assert.equal(archive.subarray(0, 2).toString(), 'PK')
  assert.ok(archive.includes('recipe.json') && archive.includes('answers/1.parquet'), 'the archive has its files')
})
