// A visitor: a fresh profile of the browser, whose page must never log an error or lose a request.
import assert from 'node:assert/strict'
import { mkdirSync } from 'node:fs'
import { join } from 'node:path'
import { after } from 'node:test'
import { AxeBuilder } from '@axe-core/playwright'
import { chromium } from 'playwright-core'

export const url = process.env.OCB_E2E_URL
const pictures = process.env.OCB_E2E_PICTURES ?? 'pictures'

// Software WebGL: the machine that runs the tests has no graphics card. Without the last flag, pages too are put together by
// it, which took a quarter of the CPU time of three journeys. Chromium's own sandbox needs a user that is not root.
const FLAGS = ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing']

// One browser for all visitors of a file, started by the first: to start one takes longer than most of them stay.
let browser
const opened = () => (browser ??= chromium.launch({ executablePath: process.env.OCB_CHROMIUM ?? '/usr/bin/chromium', headless: true, args: FLAGS }))
after(async () => (await browser)?.close())

/** Opens a profile for test `t`, on the service of the journeys or the one at `base`; it is closed, and its problems are asserted to be none, when the test ends. */
export async function visitor(t, { scheme = 'light', width = 1280, height = 900, base = url } = {}) {
  const context = await (await opened()).newContext({ colorScheme: scheme, viewport: { width, height }, acceptDownloads: true })
  context.setDefaultTimeout(30_000)
  const page = await context.newPage()
  const problems = []
  const expected = new Set()
  page.on('console', (m) => m.type() === 'error' && problems.push(`console: ${m.text()} (${m.location().url})`))
  page.on('pageerror', (e) => problems.push(`exception: ${e.message}`))
  page.on('requestfailed', (r) => {
    // Leaving a page aborts its open requests; that is the browser's doing.
    if (r.failure()?.errorText !== 'net::ERR_ABORTED') problems.push(`request: ${r.url()} ${r.failure()?.errorText}`)
  })
  page.on('response', (r) => r.status() >= 400 && problems.push(`response: ${r.status()} ${r.url()}`))
  t.after(async () => {
    if (!t.passed) await page.screenshot({ path: join(pictures, `failed-${t.name.replaceAll(/\W+/g, '-')}.png`), fullPage: true }).catch(() => {})
    await context.close()
    assert.deepEqual(problems.filter((p) => ![...expected].some((part) => p.includes(part))), [], 'the page must be free of errors')
  })
  return {
    page,
    context,
    at: (id) => page.getByTestId(id),
    /** The number behind what an element shows (`data-value`); NaN while there is none. */
    value: async (id) => Number((await page.getByTestId(id).getAttribute('data-value')) ?? NaN),
    go: (path) => page.goto(base + path),
    /** Says that refusals by this address are what the test is about. */
    expectRefusal: (path) => expected.add(path),
    api: async (path, options) => {
      const answer = await context.request.fetch(`${base}/api/v1${path}`, options)
      assert.ok(answer.ok(), `${path}: ${answer.status()} ${await answer.text()}`)
      return answer.json()
    },
    picture: async (name) => {
      mkdirSync(pictures, { recursive: true })
      await page.screenshot({ path: join(pictures, `${name}.png`) })
    },
    accessible: (what, parts) => accessible(page, what, parts),
    colours: (locator) => colours(context, locator),
  }
}

/** Logs in on the account page, or makes the account when it is `fresh`. */
export async function enter(v, name, password, fresh = false) {
  await v.go('/account')
  if (fresh) await v.at('account-switch').click()
  await v.at('account-name').fill(name)
  await v.at('account-password').fill(password)
  await v.at('account-enter').click()
  await v.at('account-who').waitFor()
}

/** No axe violation in the page, or in parts of one that is long, and nothing that scrolls sideways. */
async function accessible(page, what, parts = []) {
  // The pages have no frames of other origins, for which alone it would open a page of its own; and what passes is not listed.
  const whole = new AxeBuilder({ page }).setLegacyMode(true).options({ resultTypes: ['violations'] })
  const axe = parts.reduce((all, part) => all.include(part), whole)
  const { violations } = await axe.withTags(['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']).analyze()
  const found = violations.map((v) => `${v.id}: ${v.help} at ${v.nodes.map((n) => n.target.join(' ')).join(', ')}`)
  assert.deepEqual(found, [], `axe on ${what}`)
  const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth)
  assert.ok(over <= 0, `${what} scrolls sideways by ${over} px`)
}

/** How many strongly coloured pixels, how many different hues (of 36), and how many pixels of each an element shows. */
async function colours(context, locator) {
  const picture = (await locator.screenshot()).toString('base64')
  const blank = await context.newPage()
  try {
    return await blank.evaluate(async (data) => {
      const image = new Image()
      image.src = `data:image/png;base64,${data}`
      await image.decode()
      const canvas = new OffscreenCanvas(image.width, image.height)
      const context2d = canvas.getContext('2d')
      context2d.drawImage(image, 0, 0)
      const { data: pixels } = context2d.getImageData(0, 0, image.width, image.height)
      const hues = new Map()
      let coloured = 0
      for (let i = 0; i < pixels.length; i += 4) {
        const [r, g, b] = pixels.subarray(i, i + 3)
        const high = Math.max(r, g, b)
        const chroma = high - Math.min(r, g, b)
        if (high < 60 || chroma < 0.4 * high) continue
        coloured++
        const sixth = high === r ? ((g - b) / chroma + 6) % 6 : high === g ? (b - r) / chroma + 2 : (r - g) / chroma + 4
        const hue = Math.floor(sixth * 6)
        hues.set(hue, (hues.get(hue) ?? 0) + 1)
      }
      return { coloured, hues: [...hues.values()].filter((n) => n > 20).length, each: Object.fromEntries(hues) }
    }, picture)
  } finally {
    await blank.close()
  }
}

/** Chooses these algorithms in the builder and no others. */
export async function choose(v, chosen) {
  for (const { id } of await v.api('/algorithms')) await v.at(`algorithm-${id}`).setChecked(chosen.includes(id))
}

/** The run's id from the address of its page. */
export async function runId(page) {
  await page.waitForURL(/\/r\/[0-9a-f-]{36}/)
  return /\/r\/([0-9a-f-]{36})/.exec(page.url())[1]
}

/** A small run of all algorithms that answer distances, when it is done. */
export async function measured(v) {
  const spec = { object_a: 'stock:castle@4000', query: 'proximity', passes: 1, budget_seconds: 1, method: { kind: 'sphere', sampling: { kind: 'count', count: 400 } } }
  const { id } = await v.api('/runs', { method: 'POST', data: spec })
  return until('the run', async () => {
    const run = await v.api(`/runs/${id}`)
    return run.state === 'done' && run
  })
}

/** Waits until `probe` answers something true; long enough for a turn to measure behind those of others. */
export async function until(what, probe, seconds = 180) {
  const end = Date.now() + seconds * 1000
  for (;;) {
    const value = await probe()
    if (value) return value
    if (Date.now() > end) throw new Error(`waited ${seconds} s for: ${what}`)
    await new Promise((next) => setTimeout(next, 200))
  }
}
