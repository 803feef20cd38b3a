// The first look: a measured heatmap before anything is asked.
import assert from 'node:assert/strict'
import { after, before, test } from 'node:test'
import { startService } from '../service.mjs'
import { until, visitor } from '../visitor.mjs'

let service
before(async () => {
  service = await startService({ idle: true })
})
after(() => service?.stop())

test('a service that measures nothing unasked says so', async (t) => {
  const v = await visitor(t)
  // A service that was given to the journeys may measure unasked.
  const { idle_work: unasked } = await v.api('/status')
  await v.go('/')
  await v.at(unasked ? 'featured-viewer' : 'nothing-unasked').waitFor()
  await v.accessible('the start page without a heatmap')
  await v.picture('start-nothing')
})

test('the start page shows a measured heatmap of a stock object', async (t) => {
  const v = await visitor(t, { base: service.url })
  await v.go('/')
  // On the first start the service is still measuring it: the page says so, and shows what there is.
  await v.at('featured-viewer').locator('canvas').waitFor({ timeout: 120_000 })
  // On a busy machine the first picture is of a few queries.
  await until('a coloured object', async () => {
    const { hues, coloured } = await v.colours(v.at('featured-viewer'))
    return hues >= 4 && coloured > 2000
  })
  const marked = await v.at('preliminary').count()
  assert.ok(marked || (await v.api('/featured')).state === 'done', 'a picture that will change is not marked')
  const featured = await until('the end of its run', async () => {
    const run = await v.api('/featured')
    return run.state === 'done' && run
  }, 120)
  await until('a picture without a mark', async () => (await v.at('preliminary').count()) === 0)
  assert.ok(featured.object_a_name && (await v.page.textContent('main')).includes(featured.object_a_name))
  await v.picture('start')
  await v.accessible('the start page')
})

for (const [scheme, width] of [['light', 390], ['dark', 1440]]) {
  test(`start page and builder are accessible, ${scheme}, ${width} pixels wide`, async (t) => {
    const v = await visitor(t, { scheme, width, base: service.url })
    await v.go('/')
    await v.at('featured-viewer').locator('canvas').waitFor()
    await v.accessible('the start page')
    await v.go('/new')
    await v.at('start').waitFor()
    await v.accessible('the builder')
    await v.picture(`builder-${scheme}-${width}`)
    await v.go('/truth')
    await v.page.getByRole('heading', { level: 1, name: 'How answers are judged' }).waitFor()
    await v.accessible('how answers are judged')
    await v.page.getByRole('link', { name: 'Status' }).click()
    const { version, algorithms } = await v.api('/status')
    await v.at('status-queue').getByText(version).waitFor()
    assert.ok((await v.at('status-queue').textContent()).includes(`Algorithms${algorithms}`))
    await v.at('status-here').waitFor()
    await v.accessible('the status page')
  })
}

for (const [scheme, width] of [['light', 1280], ['dark', 390]]) {
  test(`the API page describes every route, ${scheme}, ${width} pixels wide`, async (t) => {
    const v = await visitor(t, { scheme, width })
    await v.go('/api#start_run')
    const document = await v.api('/openapi.json')
    const ids = Object.values(document.paths).flatMap((methods) => Object.values(methods).map(({ operationId }) => operationId))
    await v.at('route-start_run').waitFor()
    for (const id of ids) assert.equal(await v.at(`route-${id}`).count(), 1, id)
    await v.at('route-start_run').getByRole('link', { name: 'RunSpec' }).click()
    await v.page.waitForURL(/#schema-RunSpec$/)
    await until('the schema in view', () => v.page.locator('#schema-RunSpec h3').evaluate((e) => Math.abs(e.getBoundingClientRect().top) < 400))
    await v.picture(`api-${scheme}-${width}`)
    // The whole page takes axe a minute, so a part of each kind.
    await v.accessible('the API page', ['header', 'h1', '[data-testid="route-start_run"]', '#schema-RunSpec'])
  })
}
