// All algorithms of a run side by side, under one camera.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { measured, until, visitor } from '../visitor.mjs'

test('the wall shows every algorithm, turns by keys, opens one alone and fills the screen', async (t) => {
  const v = await visitor(t, { width: 1440 })
  const run = await measured(v)
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

test('on a telephone a swipe scrolls the page, one finger turns the object, two zoom and move it', async (t) => {
  const v = await visitor(t, { width: 390, height: 844 })
  const run = await measured(v)
  const session = await v.context.newCDPSession(v.page)
  await session.send('Emulation.setTouchEmulationEnabled', { enabled: true, maxTouchPoints: 2 })
  await v.go(`/r/${run.id}?a=${run.results.find(({ n }) => n > 0).algorithm}`)
  await v.page.locator('[data-ready="true"]').waitFor()
  const scrolled = () => v.page.evaluate(() => scrollY)
  /** The picture in the middle of the window, and the page moves no more: a swipe scrolls on after the finger has left. */
  const atRest = () => until('a page at rest', async () => {
    await v.at('viewer-0').evaluate((e) => e.scrollIntoView({ block: 'center', behavior: 'instant' }))
    const before = await scrolled()
    await v.page.waitForTimeout(300)
    return before === (await scrolled())
  })
  /** Moves fingers between these places, pixels from the middle of the picture. */
  const touch = async (from, to) => {
    await atRest()
    const box = await v.at('viewer-0').boundingBox()
    const at = (share) => from.map(([x, y], id) => ({
      id, x: box.x + box.width / 2 + x + share * (to[id][0] - x), y: box.y + box.height / 2 + y + share * (to[id][1] - y),
    }))
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: at(0) })
    for (const share of [0.2, 0.4, 0.6, 0.8, 1]) await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: at(share) })
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] })
  }
  const link = () => new URL(v.page.url()).searchParams.get('cam')
  /** The view after a movement: what it looks at, and from how far. */
  const view = async (...fingers) => {
    const before = link()
    await touch(...fingers)
    // The object turns on for a moment, and the link follows.
    let last = before
    const stays = async () => {
      const now = link()
      const same = now !== before && now === last
      last = now
      await v.page.waitForTimeout(500)
      return same && now === link() && now
    }
    const [x, y, z, ...target] = (await until('another view', stays)).split(',').map(Number)
    return { target, away: Math.hypot(x - target[0], y - target[1], z - target[2]), from: [x, y, z] }
  }

  await atRest()
  const before = await scrolled()
  await touch([[0, 60]], [[0, -60]])
  await until('a scrolled page', async () => (await scrolled()) > before + 40)
  assert.equal(link(), null, 'a swipe does not turn the object')
  const turned = await view([[-60, 0]], [[60, 0]])
  assert.deepEqual(turned.target, [0, 0, 0])
  const near = await view([[-30, 0], [30, 0]], [[-90, 0], [90, 0]])
  assert.ok(near.away < 0.7 * turned.away, `${near.away} after ${turned.away}`)
  const moved = await view([[-30, 0], [30, 0]], [[30, 40], [90, 40]])
  assert.ok(Math.hypot(...moved.target) > 0.05, `${moved.target}`)
  assert.ok(Math.abs(moved.away - near.away) < 0.1 * near.away, `${moved.away} after ${near.away}`)
  // Chosen by a tap, it turns in all directions and the page stays.
  const box = await v.at('viewer-0').boundingBox()
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 }
  // Both at once: after half a second it would be a long press, which chooses nothing.
  await Promise.all([[middle], []].map((touchPoints, up) => session.send('Input.dispatchTouchEvent', { type: up ? 'touchEnd' : 'touchStart', touchPoints })))
  await until('a chosen picture', () => v.page.evaluate(() => document.activeElement.closest('.stage') !== null))
  await atRest()
  const still = await scrolled()
  const tilted = await view([[0, 50]], [[0, -50]])
  assert.notEqual(tilted.from[1], moved.from[1])
  assert.equal(await scrolled(), still)
  await v.picture('telephone-touch')
})
