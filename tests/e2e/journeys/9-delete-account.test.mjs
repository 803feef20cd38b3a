// Somebody deletes an account: sees first what goes and what stays, takes everything along, and is nobody afterwards.
import assert from 'node:assert/strict'
import { readFile } from 'node:fs/promises'
import { test } from 'node:test'
import { enter, until, url, visitor } from '../visitor.mjs'

const PASSWORD = 'a long enough password'

test('an account is deleted, and what was public stays without a name', async (t) => {
  const [owner, other] = [await visitor(t), await visitor(t, { scheme: 'dark' })]
  await enter(owner, 'deleted-soon', PASSWORD, true)
  const spec = {
    object_a: 'stock:torus-knot@600', query: 'proximity', passes: 2, algorithms: ['box-tree', 'brute-force'],
    method: { kind: 'sphere', sampling: { kind: 'count', count: 60 } }, separation: { kind: 'relative', distance: 0.1 },
  }
  const [shown, hidden] = [0, 0].map(() => owner.api('/runs', { method: 'POST', data: spec }))
  const runs = [(await shown).id, (await hidden).id]
  for (const id of runs) await until('the run is done', async () => (await owner.api(`/runs/${id}`)).state === 'done')
  await owner.api(`/runs/${runs[0]}/visibility`, { method: 'PUT', data: { visibility: 'public' } })

  await owner.at('leave').click()
  await owner.at('deletion-goes').getByText('This permanently deletes 1 run, and your password').waitFor()
  await owner.at('deletion-stays').getByText('1 run will stay, without your name').waitFor()
  await owner.accessible('an account that is to be deleted')
  await owner.picture('account-deletion')
  const [download] = await Promise.all([owner.page.waitForEvent('download'), owner.at('export-first').click()])
  assert.ok((await readFile(await download.path())).includes('opencollbench/account.json'), 'the archive has the account')
  await owner.at('leave-not').click()
  await owner.at('leave').click()

  // Not without the password; with it, nobody is logged in any more.
  owner.expectRefusal('/api/v1/account')
  await owner.at('leave-password').fill('another password')
  await owner.at('leave-now').click()
  await owner.at('leave-problem').getByText('Wrong user name or password').waitFor()
  await owner.accessible('an account and a wrong password')
  await owner.at('leave-password').fill(PASSWORD)
  await owner.at('leave-now').click()
  await owner.at('account-deleted').getByText('The account deleted-soon is deleted and you are logged out').waitFor()
  await owner.at('account-enter').waitFor()
  await owner.accessible('the account page after the deletion')
  await owner.picture('account-deleted')
  assert.equal((await owner.api('/account')).account, null)
  await owner.at('account-name').fill('deleted-soon')
  await owner.at('account-password').fill(PASSWORD)
  await owner.at('account-enter').click()
  await owner.at('account-problem').getByText('Wrong user name or password').waitFor()

  assert.equal((await other.api(`/runs/${runs[0]}`)).visibility, 'public')
  assert.equal((await other.context.request.get(`${url}/api/v1/runs/${runs[1]}`)).status(), 404)
  await other.go(`/r/${runs[0]}`)
  await other.page.getByText('box-tree').first().waitFor()
})

test('the last curator is told why they cannot leave', async (t) => {
  const password = process.env.OCB_E2E_CURATOR
  assert.ok(password, 'OCB_E2E_CURATOR must be the password of the account "curator"')
  const curator = await visitor(t, { scheme: 'dark' })
  await enter(curator, 'curator', password, false)
  await curator.at('leave').click()
  await curator.at('deletion-blocked').getByText('This is the last curator,').waitFor()
  assert.equal(await curator.at('leave-now').count(), 0)
  await curator.accessible('an account that cannot be deleted')
  await curator.picture('deletion-blocked')
})
