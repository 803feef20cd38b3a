// How much model is enough: asked by a form, followed, read as card, chart, table and colours, taken away.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, visitor } from '../visitor.mjs'

test('a question finds its level of detail, and cancelling ends the work', async (t) => {
  const v = await visitor(t, { width: 1440 })
  await v.go('/advisor?object=stock:torus-knot')
  await v.at('stock-card-torus-knot').locator('input').check({ force: true })
  await v.accessible('the advisor’s form')
  await v.at('tolerance').fill('0')
  await v.page.getByText('The largest error is more than 0 %').waitFor()
  assert.ok(await v.at('ask').isDisabled())
  await v.at('tolerance').fill('2')
  await v.at('ask').click()
  await v.at('advice-progress').waitFor()
  await v.accessible('the advisor at work')
  await v.at('advice-card').waitFor({ timeout: 240_000 })

  const id = v.page.url().split('/').at(-1)
  const { advice } = await v.api(`/advice/${id}`)
  const number = (n) => n.toLocaleString('en-GB')
  const card = await v.at('advice-card').textContent()
  assert.ok(card.includes(`${number(advice.triangles_before)} before, ${number(advice.triangles_after)} after`), card)
  assert.match(card, /Wrong answers0 of 1,000 \(< /)
  // The table is the chart's numbers, and both are the API's.
  const rows = v.at('advice-table').locator('tbody tr')
  assert.equal(await rows.count(), advice.points.length)
  const told = await v.at('advice-chart').locator('desc').textContent()
  for (const point of advice.points) assert.ok(told.includes(`${number(point.triangles)} triangles`), told)
  const [file] = await Promise.all([v.page.waitForEvent('download'), v.at('advice-card').getByRole('link', { name: 'OBJ' }).first().click()])
  assert.match(file.suggestedFilename(), /^a-\d+\.obj$/)
  await v.page.getByText('Where detail is needed').scrollIntoViewIfNeeded()
  await until('colours', async () => (await v.colours(v.at('detail-viewer'))).hues >= 2)
  await v.picture('advisor-detail')
  await v.page.evaluate(() => scrollTo(0, 0))
  await v.picture('advisor')
  await v.accessible('the advice')

  await v.go('/advisor?object=stock:torus-knot')
  await v.at('asks-clearance').check({ force: true })
  await v.at('ask').click()
  await v.at('cancel').click()
  await v.page.getByText('This was cancelled').waitFor()
  await v.page.goBack()
})

test('an old link on a telephone, dark', async (t) => {
  const v = await visitor(t, { scheme: 'dark', width: 390 })
  v.expectRefusal('/advice/none')
  v.expectRefusal('404')
  await v.go('/advisor/none')
  await v.page.getByText('There is no advice').waitFor()
  await v.accessible('no such advice')
  await v.go('/advisor')
  await v.at('ask').waitFor()
  await v.accessible('the form')
  await v.picture('advisor-telephone')
})
