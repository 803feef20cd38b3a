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
})
