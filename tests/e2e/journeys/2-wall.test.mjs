// All algorithms of a run side by side, under one camera.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, visitor } from '../visitor.mjs'

test('the wall shows every algorithm, turns by keys, opens one alone and fills the screen', async (t) => {
  const v = await visitor(t, { width: 1440 })
  const run = await until('the first run', async () => {
    const featured = await v.api('/featured').catch(() => null)
    return featured?.state === 'done' && featured
  }, 120)
  const shown = run.results.filter(({ n }) => n > 0).map(({ algorithm }) => algorithm)
  const tiles = v.page.locator('[data-pane]')
  await v.go(`/r/${run.id}?w=1`)
  await v.page.locator('[data-ready="true"]').waitFor()
  assert.deepEqual((await tiles.evaluateAll((all) => all.map((e) => e.dataset.algorithm))).toSorted(), shown.toSorted())
  await until('coloured tiles', async () => (await v.colours(v.at('viewer-0'))).hues >= 2)
  assert.equal(await v.page.locator('.explorer canvas[aria-hidden="true"]').first().evaluate((e) => e.closest('.stage').querySelectorAll('canvas').length), 1)
  await v.accessible('the wall', ['.picture'])

  await v.at('viewer-0').focus()
  await v.page.keyboard.press('ArrowRight')
  await v.page.waitForURL(/cam=/)
  await v.page.keyboard.press('f')
  await until('the full screen', () => v.page.evaluate(() => document.fullscreenElement !== null))
  await v.page.keyboard.press('f')
  await until('the page again', () => v.page.evaluate(() => document.fullscreenElement === null))

  const second = await v.at('viewer-1').getAttribute('data-algorithm')
  await v.at('viewer-1').focus()
  await v.page.keyboard.press('Enter')
  await until('one picture', async () => (await tiles.count()) === 1)
  assert.equal(await v.at('viewer-0').getAttribute('data-algorithm'), second)
  await v.at('wall').click()
  await until('the wall again', async () => (await tiles.count()) === shown.length)
  await v.page.goBack()
  await until('the step before', async () => (await tiles.count()) === 1)

  // The cloud of closest points: coloured by itself, in the link, and Enter selects what lies near the middle.
  await v.at('viewer-0').focus()
  await v.page.keyboard.press('p')
  await v.page.waitForURL(/pt=1/)
  await v.page.getByText(/^[\d,]+ closest points, colour: points within 0\.05/).waitFor()
  await until('coloured points', async () => (await v.colours(v.at('viewer-0'))).hues >= 2)
  await v.picture('closest-points')
  await v.at('viewer-0').focus()
  await v.page.keyboard.press('Enter')
  const where = await v.at('selection').locator('li code').textContent()
  assert.match(where, /^near\(vertex \d+, 0\.05\)$/)
  const { n } = await v.api(`/runs/${run.id}/selection?${new URLSearchParams({ algorithm: second, where })}`)
  await until('the same configurations as the API', async () => (await v.value('selection-count')) === n)
  // Shift and drag draws another ball in its place, and leaves the camera alone.
  const link = new URL(v.page.url()).searchParams
  const box = await v.at('viewer-0').boundingBox()
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2]
  await v.page.keyboard.down('Shift')
  await v.page.mouse.move(x, y)
  await v.page.mouse.down()
  await v.page.mouse.move(x + 70, y, { steps: 3 })
  await v.page.mouse.up()
  await v.page.keyboard.up('Shift')
  await until('a larger ball', async () => (await v.value('selection-count')) > n)
  assert.match(await v.at('selection').locator('li code').textContent(), /^near\(vertex \d+, 0\.[1-9]\d*\)$/)
  assert.equal(new URL(v.page.url()).searchParams.get('cam'), link.get('cam'))
  await v.accessible('the closest points', ['.picture'])
  await v.picture('closest-points-selected')
})
