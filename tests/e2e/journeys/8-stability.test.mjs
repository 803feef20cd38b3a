// Where methods fail: the table by keyboard, a failing cell with everything that repeats it, the reported failures.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { visitor } from '../visitor.mjs'

const tally = (numbers) => ({ agrees: 0, grazing: 0, misses: 0, false_alarms: 0, distances: 0, unsteady: 0, broken: 0, slow: 0, unsupported: 0, refused: 0, ...numbers })
const still = ['1', '0', '0', '0', '0', '1', '0', '0', '0', '0', '1', '0', '0', '0', '0', '1']
const repro = {
  at: 1e-7, seed: 0, expected: 'no collision; distance from 1e-7 to 1e-7', got: 'collision', triangles_before: [12, 12], triangles: [1, 1],
  a: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n', b: 'v 0 0 0\nv 1 0 1\nv 0 1 1\nf 1 2 3\n', pose_a: still, pose_b: still.with(11, '0.2'),
  command: 'ocb stability hasty --family vertex-face --at 1e-7 --seed 0',
}

/** The catalogue as the service has it, with two methods that were tried on all of it. */
async function tried(v) {
  const table = await v.api('/stability')
  assert.equal(table.families.length, 28)
  assert.equal(table.relations.length, 17)
  const method = (algorithm, name, wrong) => ({
    algorithm, name, version: '1', plugin_sha256: '', single_precision: false, seeds: 3, created_us: 1.7e15, complete: true,
    families: table.families.map(({ id }, i) => {
      const fails = wrong && i % 5 === 0
      const good = tally({ agrees: 6 })
      const bad = tally({ agrees: 3, misses: 1, false_alarms: 2 })
      return {
        family: id, state: fails ? 'wrong' : 'agrees', tally: fails ? bad : good,
        steps: [1e-9, 1e-7, 1e-5, 1e-3].map((at) => ({ at, tally: fails && at < 1e-6 ? bad : good })),
        thresholds: fails ? [{ holds: 3.2e-7, fails: 1e-7 }] : [], first: fails ? repro : null,
      }
    }),
    relations: table.relations.map(({ id }) => ({ relation: id, tried: 21, decisions: wrong ? 2 : 0, distances: 0, grazing: 1, steps: [{ at: -10, tried: 3, decisions: 0, distances: 0 }, { at: 10, tried: 3, decisions: 1, distances: 0 }], first: null })),
    failures: table.failures.map(({ id }, i) => ({ id, state: wrong && i === 4 ? 'broken' : 'agrees', expected: 'no collision', got: 'no collision' })),
    tessellations: [], search: null, unit_safe: wrong ? [-10, 10] : [-40, 20], offset_safe: 65536,
  })
  const body = JSON.stringify({ ...table, methods: [method('hasty', 'Hasty', true), method('steady', 'Steady', false)] })
  await v.page.route('**/api/v1/stability', (route) => route.fulfill({ contentType: 'application/json', body }))
}

test('nothing tried yet says what to do', async (t) => {
  const v = await visitor(t)
  await v.go('/stability')
  await v.page.getByText('No method was tried yet').waitFor()
  await v.accessible('the empty stability page')
})

test('a failing cell by keyboard alone', async (t) => {
  const v = await visitor(t, { width: 1440 })
  await tried(v)
  await v.go('/stability')
  await v.at('cell-hasty-vertex-face').focus()
  await v.page.keyboard.press('ArrowRight')
  assert.equal(await v.page.evaluate(() => document.activeElement?.dataset['testid']), 'cell-hasty-edge-edge')
  await v.page.keyboard.press('ArrowLeft')
  await v.page.keyboard.press('Enter')
  const detail = v.at('stability-detail')
  await detail.getByText('right at 3.2e-7').waitFor()
  await v.at('sweep').waitFor()
  assert.equal(await v.at('pair').locator('polygon').count(), 2)
  assert.match(await detail.textContent(), /ocb stability hasty --family vertex-face --at 1e-7 --seed 0/)
  assert.match(v.page.url(), /method=hasty&part=vertex-face/)
  const files = []
  v.page.on('download', (file) => files.push(file.suggestedFilename()))
  await v.at('repro').click()
  await v.page.waitForTimeout(500)
  assert.ok(files.some((name) => name.endsWith('a.obj')), files.join())
  await v.page.evaluate(() => scrollTo(0, 0))
  await v.picture('stability')
  await v.accessible('the stability page')
})

for (const scheme of ['light', 'dark']) {
  test(`relations and reported failures, ${scheme}, on a telephone`, async (t) => {
    const v = await visitor(t, { scheme, width: 390 })
    await tried(v)
    await v.go('/stability?view=relations&method=hasty&part=unit')
    await v.at('stability-detail').getByText('2^10').waitFor()
    await v.accessible('the relations')
    await v.go('/stability?view=reported')
    await v.at('cell-hasty-drake-1668').waitFor()
    await v.accessible('the reported failures')
    await v.picture(`stability-reported-${scheme}`)
  })
}
