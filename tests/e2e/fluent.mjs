// How fluent the explorer stays with many configurations: time from a selection to its numbers on the page, as a brush makes it
// and as it is typed, and the longest that the page stood still meanwhile. `node fluent.mjs [configurations] [selections]`, on the built service.
import { chromium } from 'playwright-core'
import { startService } from './service.mjs'

const [configurations = 200_000, times = 60] = process.argv.slice(2).map(Number)
// Selections as brushes make them: a range of a column, what failed, several that hold at once.
const WHERE = [
  (x) => `time of ocb-fast in [0us, ${(1 + x).toFixed(3)}us]`,
  (x) => `near(a vertex ${Math.floor(900 * x)}, 0.1)`,
  (x) => `bv of simdop in [0, ${Math.floor(1000 * x)}] & time of ocb-fast in [0.5us, 1s]`,
  () => '!(wrong of simdop | flipped of ocb-fast)',
]
const SPEC = {
  object_a: 'stock:torus-knot@2000', query: 'collision_first', separation: { kind: 'step', of_size: 2e-3 }, passes: 1, budget_seconds: 300,
  algorithms: ['ocb-fast', 'simdop'],
  method: { kind: 'sphere', seed: 1, sampling: { kind: 'count', count: configurations } },
}

const quantile = (sorted, q) => sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))]
function line(name, numbers) {
  const sorted = numbers.toSorted((a, b) => a - b)
  const [low, middle, high] = [0.05, 0.5, 0.95].map((q) => quantile(sorted, q).toFixed(1))
  console.log(`${name}: median ${middle} ms, 5 to 95 of 100 ${low} to ${high} ms, most ${sorted.at(-1).toFixed(1)} ms, n = ${sorted.length}`)
}

async function finished(page, url) {
  const answer = await page.request.post(`${url}/api/v1/runs`, { data: SPEC })
  if (!answer.ok()) throw new Error(await answer.text())
  const { id } = await answer.json()
  for (let shown = ''; ;) {
    const run = await (await page.request.get(`${url}/api/v1/runs/${id}`)).json()
    if (run.state === 'done') return run
    if (!['queued', 'running'].includes(run.state)) throw new Error(`the run is ${run.state}: ${run.error ?? ''}`)
    const now = JSON.stringify(run.progress ?? run.state)
    if (now !== shown) console.error((shown = now))
    await new Promise((next) => setTimeout(next, 5000))
  }
}

/** Asks for one selection by hand and waits for its answer; gives both times in ms. */
async function ask(page, where) {
  await page.getByTestId('selection-where').fill(where)
  await page.evaluate(() => {
    performance.clearMeasures('selection')
    const still = { longest: 0, last: performance.now(), on: true }
    window.still = still
    const frame = (now) => {
      still.longest = Math.max(still.longest, now - still.last)
      still.last = now
      if (still.on) requestAnimationFrame(frame)
    }
    requestAnimationFrame(frame)
    document.querySelector('[data-testid="selection-add"]').addEventListener('click', () => (window.clicked = performance.now()), { once: true })
  })
  await page.getByTestId('selection-add').click()
  if (await page.getByTestId('selection-refusal').count()) throw new Error(await page.getByTestId('selection-refusal').textContent())
  await page.waitForFunction(() => performance.getEntriesByName('selection').length > 0)
  await page.waitForTimeout(300)
  const times = await page.evaluate(() => {
    window.still.on = false
    const { startTime, duration } = performance.getEntriesByName('selection').at(-1)
    return [duration, startTime + duration - window.clicked, window.still.longest]
  })
  const n = Number(await page.getByTestId('selection-count').getAttribute('data-value'))
  if (!Number.isFinite(n)) throw new Error(`no answer to ${where}`)
  await page.getByTestId('selection-remove-0').click()
  // Until the pictures are drawn again: what is measured is a selection beside a renderer that has nothing to do.
  await page.waitForFunction(() => !document.querySelector('[data-testid="selection-name-0"]'))
  await page.waitForTimeout(1000)
  return { times, n }
}

const service = await startService()
const flags = ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']
const browser = await chromium.launch({ executablePath: process.env.OCB_CHROMIUM ?? '/usr/bin/chromium', headless: true, args: flags })
try {
  const page = await (await browser.newContext({ viewport: { width: 1440, height: 1000 } })).newPage()
  const run = await finished(page, service.url)
  await page.goto(`${service.url}/r/${run.id}`)
  // The first question fetches the records, which is no selection's time.
  await page.waitForFunction(() => performance.getEntriesByName('selection').length > 0, undefined, { timeout: 120_000 })
  await page.waitForTimeout(5000)
  const answers = []
  for (let i = 0; i < times; i++) answers.push(await ask(page, WHERE[i % WHERE.length](((i * 7) % times) / times)))
  console.log(`${run.set.configurations} configurations; selected ${answers.map(({ n }) => n).join(' ')}`)
  line('selection', answers.map(({ times }) => times[0]))
  line('the same typed, which is read first', answers.map(({ times }) => times[1]))
  line('longest time between two frames', answers.map(({ times }) => times[2]))
} finally {
  await browser.close()
  await service.stop()
}
