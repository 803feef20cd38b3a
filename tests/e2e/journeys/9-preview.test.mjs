// The cheaper run first: a quick look, what more would buy, and the same run refined.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { choose, runId, until, visitor } from '../visitor.mjs'

const WHOLE = 6000

/** Random poses of a small knot against itself, all but free to find, for two algorithms: all of them take minutes. */
async function build(v) {
  await v.go('/new')
  await v.at('stock-card-torus-knot').click()
  await v.at('triangles').fill('0')
  await v.at('method-random').click()
  await v.at('count').fill(String(WHOLE))
  await v.at('passes').fill('3')
  await choose(v, ['box-tree', 'ocb-fast'])
  await until('an estimate', async () => (await v.value('estimate-configurations')) === WHOLE)
  await v.at('efforts').waitFor()
}

test('the quick look is proposed first, is marked as a preview, and is refined in place', async (t) => {
  const v = await visitor(t)
  await build(v)
  assert.ok(await v.at('effort-quick').isChecked(), 'the cheaper run is proposed')
  await until('its cost', async () => v.at('start').isEnabled())
  const quick = await v.value('estimate-seconds')
  await v.at('efforts').getByText('1 in 1,666').waitFor()
  assert.match(await v.at('command').textContent(), /--quick/)
  await v.accessible('the builder with its efforts')
  await v.at('efforts').scrollIntoViewIfNeeded()
  await v.picture('effort-light-1280')
  // By keyboard: the next ones cost more and say so.
  await v.at('effort-quick').focus()
  await v.page.keyboard.press('ArrowDown')
  assert.match(await v.at('command').textContent(), /--precision 5%/)
  await v.page.keyboard.press('ArrowDown')
  assert.doesNotMatch(await v.at('command').textContent(), /--quick|--precision/)
  assert.ok((await v.value('estimate-seconds')) >= quick)
  await v.page.keyboard.press('ArrowUp')
  await v.page.keyboard.press('ArrowUp')
  await v.at('start').click()

  const id = await runId(v.page)
  await v.at('preview').waitFor({ timeout: 300_000 })
  const run = await v.api(`/runs/${id}`)
  assert.deepEqual([run.preview.n, run.preview.of, run.set.configurations], [5000, WHOLE, 5000])
  const shown = await v.at('preview').textContent()
  for (const words of ['5,000 of 6,000', run.preview.finding, run.preview.more, 'no place on the board']) assert.ok(shown.includes(words), `${words} in ${shown}`)
  await v.accessible('a preview')
  await v.picture('preview-light-1280')

  // Who has only the link sees the preview and cannot refine it.
  const other = await visitor(t, { scheme: 'dark', width: 390 })
  await other.go(`/r/${id}`)
  await other.at('preview').waitFor()
  assert.equal(await other.at('refine').count(), 0, 'a stranger cannot refine')
  await other.accessible('a preview, dark, 390 pixels wide')
  await other.picture('preview-dark-390')
  await other.go('/new')
  await other.at('efforts').waitFor()
  await other.accessible('the builder with its efforts, dark, 390 pixels wide')
  await other.at('efforts').scrollIntoViewIfNeeded()
  await other.picture('effort-dark-390')

  await v.at('refine').focus()
  await v.page.keyboard.press('Enter')
  await until('the whole run', async () => {
    const { state, preview } = await v.api(`/runs/${id}`)
    return state === 'done' && preview === null
  })
  await until('no badge', async () => (await v.at('preview').count()) === 0)
  await v.at('result-table').waitFor()
  assert.ok((await v.api(`/runs/${id}`)).results.every(({ n }) => n === WHOLE))
})
