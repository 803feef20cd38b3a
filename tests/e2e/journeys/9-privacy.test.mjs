// Somebody keeps a run, then an object, to themselves: the link that worked leads nowhere, until they share it again.
import { Buffer } from 'node:buffer'
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, url, visitor } from '../visitor.mjs'

/** A closed octahedron. */
const OBJ = ['1 0 0', '-1 0 0', '0 1 0', '0 -1 0', '0 0 1', '0 0 -1'].map((v) => `v ${v}\n`).join('')
  + ['1 3 5', '3 2 5', '2 4 5', '4 1 5', '3 1 6', '2 3 6', '4 2 6', '1 4 6'].map((f) => `f ${f}\n`).join('')

const choose = (v, kind, who) => v.at(`visibility-${kind}`).selectOption(who)

test('what one keeps to oneself is not there for others', async (t) => {
  const [owner, other] = [await visitor(t), await visitor(t, { scheme: 'dark' })]
  await owner.go('/objects')
  const multipart = { file: { name: 'octahedron.obj', mimeType: 'model/obj', buffer: Buffer.from(OBJ) } }
  const object = await owner.api('/objects', { method: 'POST', multipart })
  const spec = {
    object_a: object.id, query: 'proximity', passes: 2, algorithms: ['box-tree', 'brute-force'],
    method: { kind: 'sphere', sampling: { kind: 'count', count: 60 } }, separation: { kind: 'relative', distance: 0.1 },
  }
  const run = await owner.api('/runs', { method: 'POST', data: spec })
  await until('the run is done', async () => (await owner.api(`/runs/${run.id}`)).state === 'done')
  const seen = async () => (await other.context.request.get(`${url}/api/v1/runs/${run.id}`)).status()
  other.expectRefusal(`/runs/${run.id}`)

  await owner.go(`/r/${run.id}`)
  await owner.at('visibility-run').waitFor()
  assert.equal(await owner.at('visibility-run').inputValue(), 'unlisted')
  assert.ok(await owner.page.locator('option[value=public]').isDisabled(), 'guests do not publish')
  assert.equal(await seen(), 200)
  await choose(owner, 'run', 'private')
  await until('the run is hidden', async () => (await seen()) === 404)
  await owner.accessible('a run of one\'s own')
  await owner.picture('privacy-run')
  await other.go(`/r/${run.id}`)
  await other.page.getByText('There is no run').waitFor()
  await other.accessible('a run that is not there')
  await other.picture('privacy-nothing')

  // With its object the run is shared and hidden, too.
  await choose(owner, 'run', 'unlisted')
  await until('the run is there again', async () => (await seen()) === 200)
  await owner.go('/objects')
  await choose(owner, 'object', 'private')
  await until('the run is hidden with its object', async () => (await seen()) === 404)
  await owner.accessible('objects of one\'s own')
  await owner.picture('privacy-objects')
  await owner.go(`/r/${run.id}`)
  owner.expectRefusal(`/runs/${run.id}/visibility`)
  await until('the run says so', async () => (await owner.at('visibility-run').inputValue()) === 'private')
  await choose(owner, 'run', 'unlisted')
  await owner.page.getByText('is private; make that unlisted first').waitFor()
  await owner.picture('privacy-first-the-object')
})
