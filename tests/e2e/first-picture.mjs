// How long a visitor waits for the first coloured object: on the start page of a fresh service, after Start on the bunny, and
// after dropping a file of 65,536 triangles; each in a fresh browser, and again in the same one. `node first-picture.mjs [times]`,
// on the built service and its pages.
//
// The frames that the browser shows are recorded with their times and looked at afterwards, so that looking costs nothing.
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { chromium } from 'playwright-core'
import { root, startService } from './service.mjs'

const times = Number(process.argv[2] ?? 5)
const shared = process.env.OCB_SHARED ?? join(root, '../shared')
const FLAGS = ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']
const [WIDTH, HEIGHT] = [1280, 900]
/** So many hues of more than 20 pixels each are a picture, and no marker before a title. */
const HUES = 3

/** Runs in the page, before anything of it: notes when the visitor clicks Start or has chosen a file, and when there is a viewer. */
function note(viewer) {
  window.begun = window.viewed = 0
  const look = () => document.querySelector(`[data-testid="${viewer}"]`) && (window.viewed ||= Date.now())
  new MutationObserver(look).observe(document, { childList: true, subtree: true })
  addEventListener('click', ({ target }) => target.closest?.('[data-testid="start"]') && (window.begun ||= Date.now()), true)
  addEventListener('change', ({ target }) => target.type === 'file' && (window.begun ||= Date.now()), true)
}

/** Runs in the page: the index of the first frame that shows a coloured object in the box; null if none does. */
async function firstColoured([frames, box, enough]) {
  const canvas = new OffscreenCanvas(Math.ceil(box.width), Math.ceil(box.height))
  const context = canvas.getContext('2d', { willReadFrequently: true })
  for (const [index, data] of frames.entries()) {
    const image = new Image()
    image.src = `data:image/jpeg;base64,${data}`
    await image.decode()
    context.drawImage(image, -box.x, -box.y)
    const { data: pixels } = context.getImageData(0, 0, canvas.width, canvas.height)
    const hues = new Array(36).fill(0)
    for (let i = 0; i < pixels.length; i += 4) {
      const [r, g, b] = pixels.subarray(i, i + 3)
      const high = Math.max(r, g, b)
      const chroma = high - Math.min(r, g, b)
      if (high < 60 || chroma < 0.4 * high) continue
      const sixth = high === r ? ((g - b) / chroma + 6) % 6 : high === g ? (b - r) / chroma + 2 : (r - g) / chroma + 4
      hues[Math.floor(sixth * 6) % 36]++
    }
    if (hues.filter((n) => n > 20).length >= enough) return index
  }
  return null
}

const launch = () => chromium.launch({ executablePath: process.env.OCB_CHROMIUM ?? '/usr/bin/chromium', headless: true, args: FLAGS })

/** A visit to a page; gives the seconds until the first coloured pixels in `viewer`. A run that it started is cancelled. */
async function visit(context, service, path, viewer, act) {
  const page = await context.newPage()
  try {
    await page.addInitScript(note, viewer)
    const session = await context.newCDPSession(page)
    const frames = []
    session.on('Page.screencastFrame', ({ data, metadata, sessionId }) => {
      frames.push({ data, at: 1000 * metadata.timestamp })
      // The page may have been closed.
      session.send('Page.screencastFrameAck', { sessionId }).catch(() => {})
    })
    await session.send('Page.startScreencast', { format: 'jpeg', quality: 80, maxWidth: WIDTH, maxHeight: HEIGHT })
    const opened = Date.now()
    await page.goto(service.url + path)
    await act(page)
    const pane = page.getByTestId(viewer)
    await pane.waitFor({ timeout: 120_000 })
    const noted = await page.evaluate(() => ({ begun: window.begun, viewed: window.viewed }))
    const begun = noted.begun || opened
    const box = await pane.boundingBox()
    for (const end = Date.now() + 120_000; Date.now() < end;) {
      await page.waitForTimeout(5000)
      const shown = frames.filter(({ at }) => at > noted.viewed)
      const first = await looker.evaluate(firstColoured, [shown.map(({ data }) => data), box, HUES])
      if (first === null) continue
      const [, run] = /\/r\/([0-9a-f-]{36})/.exec(page.url()) ?? []
      if (run) await page.evaluate((id) => fetch(`/api/v1/runs/${id}/cancel`, { method: 'POST' }), run)
      return (shown[first].at - begun) / 1000
    }
    throw new Error(`no picture on ${path}`)
  } finally {
    await page.close()
  }
}

/** Clicks Start as soon as this holds for the summary and Start is enabled. */
const start = (page, words) =>
  page.waitForFunction((words) => {
    const button = document.querySelector('[data-testid="start"]')
    const ready = button && !button.disabled && document.querySelector('aside').textContent.toLowerCase().includes(words)
    if (ready) button.click()
    return ready
  }, words, { timeout: 120_000 })

/** A file of a visitor's; where there is no shared bunny, a knot of the service. */
async function ownFile(service) {
  try {
    return { name: 'own.obj', mimeType: 'model/obj', buffer: readFileSync(join(shared, 'meshes/bunny65k.obj')) }
  } catch {
    const mesh = await fetch(`${service.url}/api/v1/objects/${encodeURIComponent('stock:torus-knot@65000')}/mesh.glb`)
    return { name: 'own.glb', mimeType: 'model/gltf-binary', buffer: Buffer.from(await mesh.arrayBuffer()) }
  }
}

/** The run of the start page is measured to its end, so that nothing waits. */
async function quiet({ url }) {
  for (;;) {
    const run = await (await fetch(`${url}/api/v1/featured`)).json()
    if (run && run.state === 'done') return
    await new Promise((next) => setTimeout(next, 500))
  }
}

const ROWS = {
  'start page, fresh service': async (context, service) => visit(context, service, '/', 'featured-viewer', async () => {}),
  'Start on the bunny': async (context, service) => {
    await quiet(service)
    return visit(context, service, '/new', 'viewer-0', (page) => start(page, 'bunny'))
  },
  'own file, 65,536 triangles': async (context, service) => {
    const file = await ownFile(service)
    return visit(context, service, '/new', 'viewer-0', async (page) => {
      await page.getByTestId('start').waitFor()
      await page.getByTestId('file-input').setInputFiles(file)
      await start(page, 'own against')
    })
  },
}

const watching = await launch()
const looker = await watching.newPage()
const found = Object.fromEntries(Object.keys(ROWS).flatMap((name) => [[name, []], [`${name}, again`, []]]))
for (let i = 0; i < times; i++) {
  const service = await startService({ idle: true })
  try {
    for (const [name, measure] of Object.entries(ROWS)) {
      const browser = await launch()
      const context = await browser.newContext({ viewport: { width: WIDTH, height: HEIGHT } })
      for (const which of [name, `${name}, again`]) {
        found[which].push(await measure(context, service))
        console.error(`${which}: ${found[which].at(-1).toFixed(2)} s`)
      }
      await browser.close()
    }
  } finally {
    await service.stop()
  }
}
await watching.close()
console.log('seconds to the first coloured pixels | median | least | most | n')
for (const [name, seconds] of Object.entries(found)) {
  const sorted = seconds.toSorted((a, b) => a - b)
  console.log([name, sorted[Math.floor(sorted.length / 2)].toFixed(2), sorted[0].toFixed(2), sorted.at(-1).toFixed(2), sorted.length].join(' | '))
}
