// How much model is enough: asked by a form, followed, read as card, chart, table and colours, taken away.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, url, visitor } from '../visitor.mjs'

/** A knot of few triangles among the visitor's own objects: advice on the stock object takes much longer. */
async function smallKnot(v) {
  const mesh = await v.context.request.get(`${url}/api/v1/objects/stock:torus-knot@1000/mesh.glb`)
  const multipart = { file: { name: 'knot.glb', mimeType: 'model/gltf-binary', buffer: await mesh.body() } }
  const { id } = await v.api('/objects', { method: 'POST', multipart })
  return id
}

test('a question finds its level of detail, and cancelling ends the work', async (t) => {
  const v = await visitor(t, { width: 1440 })
  await v.go('/advisor?object=stock:torus-knot')
  await v.at('stock-card-torus-knot').locator('input').check({ force: true })
  await v.accessible('the advisor’s form')
  await v.go(`/advisor?object=${await smallKnot(v)}`)
  await v.at('tolerance').fill('0')
  await v.page.getByText('The largest error must be more than 0 %').waitFor()
  assert.ok(await v.at('ask').isDisabled())
  // So much that fewer than these thousand triangles are enough.
  await v.at('tolerance').fill('10')
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
  for (const point of advice.points) assert.ok(told.includes(`${number(point.elements)} ${point.unit}`), told)
  for (const kind of ['convex_parts', 'inner_spheres', 'voxels', 'double_precision', 'single_precision'])
    assert.ok(advice.points.some((point) => point.kind === kind) || advice.left_out.length > 0, kind)
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
  await v.page.getByText('This advice was cancelled').waitFor()
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
