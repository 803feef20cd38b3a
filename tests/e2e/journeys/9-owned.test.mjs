// A guest sees until when everything is kept, keeps it longer, takes it along, and takes it away.
import assert from 'node:assert/strict'
import { readFile } from 'node:fs/promises'
import { test } from 'node:test'
import { until, url, visitor } from '../visitor.mjs'

test('what one has made is kept, taken along and taken away', async (t) => {
  const guest = await visitor(t)
  const spec = {
    object_a: 'stock:torus-knot@600', query: 'proximity', passes: 2, algorithms: ['box-tree', 'brute-force'],
    method: { kind: 'sphere', sampling: { kind: 'count', count: 60 } }, separation: { kind: 'relative', distance: 0.1 },
  }
  await guest.go('/runs')
  const runs = []
  for (let i = 0; i < 2; i++) runs.push((await guest.api('/runs', { method: 'POST', data: spec })).id)
  await until('the runs are done', async () => (await guest.api(`/runs/${runs[1]}`)).state === 'done')
  await guest.go('/runs')
  const kept = await guest.value('kept-until')
  assert.ok(Math.abs(kept / 1000 - Date.now() - 30 * 24 * 3600e3) < 24 * 3600e3, String(kept))
  await guest.at('keep-longer').click()
  await until('it is kept longer', async () => (await guest.value('kept-until')) > kept)
  await guest.accessible('my runs')
  await guest.picture('things')

  const [download] = await Promise.all([guest.page.waitForEvent('download'), guest.at('export-data').click()])
  const archive = await readFile(await download.path())
  assert.equal(archive.subarray(257, 262).toString(), 'ustar')
  assert.ok(archive.includes(`opencollbench/runs/${runs[0]}/run.json`), 'the archive has the run')

  // One run: shown first, then gone; the address leads nowhere any more.
  await guest.go(`/r/${runs[0]}`)
  await guest.at('remove').click()
  await guest.page.getByText('1 run will be deleted permanently').waitFor()
  await guest.accessible('a run that is to go')
  await guest.picture('things-one')
  await guest.at('remove-now').click()
  await guest.page.waitForURL(/\/runs$/)
  assert.equal((await guest.context.request.get(`${url}/api/v1/runs/${runs[0]}`)).status(), 404)

  // Everything.
  await guest.at('remove').click()
  await guest.at('goes').getByText('1 run will be deleted permanently').waitFor()
  await guest.picture('things-all')
  await guest.at('remove-now').click()
  await guest.page.getByText('No runs yet').waitFor()
  assert.deepEqual(await guest.api('/runs'), [])
})
