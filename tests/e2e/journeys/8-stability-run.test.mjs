// A visitor has an algorithm tested: starts a stability run, sees its place and progress, cancels one, and opens the result of another.
import assert from 'node:assert/strict'
import { mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { built, startService } from '../service.mjs'
import { enter, until, visitor } from '../visitor.mjs'

const FAMILY = 'vertex-face'

/** Fills in the form and starts with the Enter key; gives the run's id. */
async function start(v, algorithm, tests) {
  await v.go('/stability')
  await v.at('stability-algorithm').selectOption(algorithm)
  await v.at('stability-tests').selectOption(tests)
  await v.at('stability-seeds').fill('1')
  await v.at('stability-seeds').press('Enter')
  await v.page.waitForURL(/\/stability\/[0-9a-f-]{36}/)
  return /\/stability\/([0-9a-f-]{36})/.exec(v.page.url())[1]
}

const state = (v) => v.at('stability-progress').getAttribute('data-state')

test('a small run is started, followed and opened', async (t) => {
  const v = await visitor(t, { width: 1920, height: 1080 })
  const id = await start(v, 'box-tree', FAMILY)
  await until('the run to end', async () => (await state(v)) === 'done')
  // The only cell is shown, with the numbers of the result.
  const { result } = await v.api(`/stability-runs/${id}`)
  const detail = v.at('stability-detail')
  await detail.waitFor()
  assert.match(await detail.textContent(), new RegExp(`${result.families[0].tally.agrees} right`))
  await v.at('sweep').waitFor()
  await v.accessible('the page of a stability run')
  await v.picture('stability-run')
  const [file] = await Promise.all([v.page.waitForEvent('download'), v.at('stability-json').click()])
  assert.match(file.suggestedFilename(), /^stability_box-tree_.*\.json$/)

  for (const width of [1920, 1024, 390]) {
    await v.page.setViewportSize({ width, height: 900 })
    await v.go('/stability')
    const row = v.at('stability-runs').locator(`[data-run="${id}"]`)
    await row.getByText('done').first().waitFor()
    assert.match(await row.textContent(), /1 of 1 tests done/)
    await v.accessible(`the stability page, ${width} px`)
    await v.picture(`stability-form-${width}`)
  }
  await v.at('stability-runs').locator(`[data-run="${id}"] a`).click()
  await detail.waitFor()
  await v.accessible('the page of a stability run on a telephone')
  await v.picture('stability-run-390')
  await v.at('stability-delete').click()
  await v.page.waitForURL(/\/stability$/)
  await until('the list to be empty', async () => (await v.at('stability-runs').count()) === 0)
})

test('a failing case of one\'s own run is downloaded', async (t) => {
  const v = await visitor(t)
  await start(v, 'parry-f32', FAMILY)
  await until('the run to end', async () => (await state(v)) === 'done')
  await v.at('pair').waitFor()
  const files = []
  v.page.on('download', (file) => files.push(file.suggestedFilename()))
  await v.at('repro').click()
  await until('the files', () => files.length === 3)
  assert.deepEqual(files.map((name) => name.split('_').at(-1)).sort(), ['a.obj', 'b.obj', 'case.json'])
})

test('two runs wait for each other and are cancelled by their owner and by a curator', async (t) => {
  const v = await visitor(t)
  const first = await start(v, 'box-tree', 'all')
  await until('the run to begin', async () => (await state(v)) === 'running')
  const second = await start(v, 'box-tree', 'relations')
  await v.page.getByText('1 stability run ahead in the queue').waitFor()
  await v.accessible('a stability run that waits')
  await v.page.setViewportSize({ width: 1024, height: 900 })
  await v.picture('stability-waiting')

  const curator = await visitor(t)
  await enter(curator, 'curator', process.env.OCB_E2E_CURATOR)
  await curator.go('/curate')
  await curator.at('open-stability-runs').locator(`[data-run="${second}"] button`).click()
  await until('the run to be cancelled', async () => (await state(v)) === 'cancelled')
  await v.page.getByText('Cancelled by a curator.').waitFor()

  await v.go('/stability')
  await v.at('stability-runs').locator(`[data-run="${first}"] button`).click()
  await v.at('stability-runs').locator(`[data-run="${first}"]`).getByText('cancelled').waitFor()
  const { done, total } = await v.api(`/stability-runs/${first}`)
  assert.ok(done < total)
})

test('a run whose service was killed continues behind the tests that were done', async (t) => {
  const data = mkdtempSync(join(tmpdir(), 'ocb-stability-'))
  t.after(() => rmSync(data, { recursive: true, force: true }))
  const options = ['--plugins', built('libocb_box_tree.so')]
  const first = await startService({ data, options })
  t.after(first.kill)
  const v = await visitor(t, { base: first.url })
  v.expectRefusal(`${first.url}/api/v1/stability-runs/`)
  const id = await start(v, 'box-tree', 'families')
  const before = await until('some tests to be done', async () => {
    const run = await v.api(`/stability-runs/${id}`)
    return run.done > 1 && run
  })
  await first.kill()
  await v.page.getByRole('alert').first().waitFor()

  // The open page follows the run as soon as there is a service again.
  const second = await startService({ data, options, url: first.url })
  t.after(second.stop)
  const after = await v.api(`/stability-runs/${id}`)
  assert.ok(after.done >= before.done && after.done < after.total, `${before.done}, then ${after.done} of ${after.total}`)
  await until('the run to end', async () => (await state(v)) === 'done')
  assert.equal(await v.page.getByRole('alert').count(), 0)
  const { done, total, result } = await v.api(`/stability-runs/${id}`)
  assert.deepEqual([done, result.families.length], [total, total])
  // The results from before the kill are unchanged.
  assert.deepEqual(result.families.slice(0, before.done), before.result.families.slice(0, before.done))
})
