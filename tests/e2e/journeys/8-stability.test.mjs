// Where methods fail: the table by keyboard, a failing cell with everything that repeats it, the reported failures. The numbers
// are those of two methods that were tried before the service started; the one in single precision fails.
import assert from 'node:assert/strict'
import { mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { after, before, test } from 'node:test'
import { built, ocb, startService } from '../service.mjs'
import { visitor } from '../visitor.mjs'

const METHODS = ['parry-f32', 'box-tree']
const options = ['libocb_parry.so', 'libocb_box_tree.so'].flatMap((name) => ['--plugins', built(name)])
const data = mkdtempSync(join(tmpdir(), 'ocb-stability-'))
let service

before(async () => {
  // 3: a method has failures.
  ocb(['stability', ...METHODS, '--seeds', '1', '--data', data, ...options], {}, 3)
  service = await startService({ data, options })
})
after(async () => {
  await service?.stop()
  rmSync(data, { recursive: true, force: true })
})

/** What the service says of the method that fails. */
async function failing(v) {
  const table = await v.api('/stability')
  assert.equal(table.families.length, 28)
  assert.equal(table.relations.length, 17)
  assert.deepEqual(table.methods.map(({ algorithm }) => algorithm).sort(), [...METHODS].sort())
  return table.methods.find(({ algorithm }) => algorithm === 'parry-f32')
}

test('nothing tried yet says what to do', async (t) => {
  const v = await visitor(t)
  await v.go('/stability')
  await v.page.getByText('No algorithm has been tested yet').waitFor()
  await v.accessible('the empty stability page')
})

test('a failing cell by keyboard alone', async (t) => {
  const v = await visitor(t, { width: 1440, base: service.url })
  const { thresholds: [{ holds, fails }], first } = (await failing(v)).families.find(({ family }) => family === 'vertex-face')
  await v.go('/stability')
  await v.at('cell-parry-f32-vertex-face').focus()
  await v.page.keyboard.press('ArrowRight')
  assert.equal(await v.page.evaluate(() => document.activeElement?.dataset['testid']), 'cell-parry-f32-edge-edge')
  await v.page.keyboard.press('ArrowLeft')
  await v.page.keyboard.press('Enter')
  const detail = v.at('stability-detail')
  const said = await v.at('threshold').first().textContent()
  const shown = /gap ([0-9.e-]+); right at ([0-9.e-]+)\./.exec(said)?.slice(1).map(Number)
  assert.ok(shown && Math.abs(shown[0] / fails - 1) < 0.01 && Math.abs(shown[1] / holds - 1) < 0.01, said)
  await v.at('sweep').waitFor()
  assert.equal(await v.at('pair').locator('polygon').count(), 2)
  assert.equal(await detail.locator('pre').textContent(), first.command)
  assert.match(v.page.url(), /method=parry-f32&part=vertex-face/)
  const files = []
  v.page.on('download', (file) => files.push(file.suggestedFilename()))
  await v.at('repro').click()
  await v.page.waitForTimeout(500)
  assert.ok(files.some((name) => name.endsWith('a.obj')), files.join())
  await v.page.evaluate(() => scrollTo(0, 0))
  await v.picture('stability')
  await v.accessible('the stability page')
  // Both algorithms have times, and their marks say where they fail.
  const chart = v.at('threshold-chart')
  await chart.scrollIntoViewIfNeeded()
  assert.match(await chart.locator('desc').textContent(), /Box ?Tree: no failure down to .*parry.*: fails from|parry.*: fails from .*Box ?Tree: no failure down to /)
  assert.equal(await chart.locator('.range').count(), METHODS.length)
  await v.picture('stability-thresholds')
})

for (const scheme of ['light', 'dark']) {
  test(`relations and reported failures, ${scheme}, on a telephone`, async (t) => {
    const v = await visitor(t, { scheme, width: 390, base: service.url })
    const unit = (await failing(v)).relations.find(({ relation }) => relation === 'unit')
    assert.ok(unit.decisions > 0, 'single precision depends on the unit of length')
    await v.go('/stability?view=relations&method=parry-f32&part=unit')
    const rows = v.at('stability-detail').locator('tbody tr')
    await rows.first().waitFor()
    assert.deepEqual(
      await rows.evaluateAll((all) => all.map((row) => row.textContent)),
      unit.steps.map(({ at, tried, decisions, distances }) => `2^${at}${tried}${decisions}${distances}`),
    )
    await v.accessible('the relations')
    await v.go('/stability?view=reported')
    await v.at('cell-parry-f32-drake-1668').waitFor()
    await v.accessible('the reported failures')
    await v.picture(`stability-reported-${scheme}`)
  })
}
