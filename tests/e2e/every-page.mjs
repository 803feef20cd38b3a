// Every page at three widths in both themes, with something on it: `node every-page.mjs`, on the built service. The pictures are in
// target/e2e/pages, to be looked at; it fails where a page scrolls sideways, axe finds something, or a page logs an error.
import assert from 'node:assert/strict'
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { recording } from './recording.mjs'
import { addCurator, built, ocb, root, startService } from './service.mjs'
import { enter, until, visitor } from './visitor.mjs'

const WIDTHS = [390, 1024, 1920]
const SCHEMES = ['light', 'dark']
const SUITE = {
  version: 9, scenes: [['stock:torus-knot@600', 'stock:torus-knot@600']], separations: [{ kind: 'relative', distance: 0.1 }],
  queries: ['collision_first', 'proximity'], configurations: 200, seed: 1, passes: 3, budget_seconds: 5,
}
const ALGORITHMS = ['box-tree', 'parry-f32', 'simdop', 'ocb-fast']
const options = ['libocb_box_tree.so', 'libocb_parry.so', 'libocb_simdop.so', 'libocb_fast.so'].flatMap((name) => ['--plugins', built(name)])

/** Makes something for every page to show; gives the pages' addresses. */
async function fill(v) {
  const post = (path, data) => v.api(path, { method: 'POST', data })
  const run = await post('/runs', {
    object_a: 'stock:torus-knot@2000', query: 'collision_first', algorithms: ALGORITHMS, passes: 3, budget_seconds: 10,
    separation: { kind: 'ladder' }, method: { kind: 'sphere', seed: 1, sampling: { kind: 'count', count: 400 } },
  })
  const tried = await post('/stability-runs', { algorithm: 'parry-f32', parts: ['vertex-face'], seeds: 1 })
  const advice = await post('/advice', { object_a: 'stock:torus-knot@2000', question: { kind: 'distance', tolerance: 0.02 } })
  const campaign = await post('/campaigns', { reason: 'A new machine.' })
  await v.go('/workloads')
  await v.at('workload-file').setInputFiles(recording())
  await v.at('workload-passes').fill('2')
  await v.at('workload-passes').press('Enter')
  await v.page.waitForURL(/\/workloads\/[0-9a-f-]{36}/)
  const workload = v.page.url().split('/').at(-1)
  await v.go('/submit')
  await v.at('plugin-file').setInputFiles(built('libocb_brute_force.so'))
  const fields = { name: 'All pairs', version: '1.0', authors: 'Ada', license: 'MIT OR Apache-2.0', source: 'https://example.org/all-pairs' }
  for (const [field, text] of Object.entries(fields)) await v.at(`manifest-${field}`).fill(text)
  await v.at('submit-plugin').click()
  await v.page.waitForURL(/\/p\/[0-9a-f-]{36}/)
  const plugin = v.page.url().split('/').at(-1)
  await v.go('/new')
  const tetrahedron = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n'
  await v.at('file-input').setInputFiles({ name: 'tetrahedron.obj', mimeType: 'text/plain', buffer: Buffer.from(tetrahedron) })
  await v.page.getByText('tetrahedron').first().waitFor()
  for (const path of [`/runs/${run.id}`, `/stability-runs/${tried.id}`, `/workloads/${workload}`, `/campaigns/${campaign.id}`])
    await until(`${path} to end`, async () => ['done', 'failed', 'cancelled'].includes((await v.api(path)).state), 300)
  await until('the check', async () => !['uploaded', 'vetted'].includes((await v.api(`/plugins/${plugin}`)).state), 300)
  await until('the advice', async () => (await v.api(`/advice/${advice.id}`)).advice, 300)
  return {
    start: '/', new: '/new', run: `/r/${run.id}`, board: '/board', runs: '/runs', objects: '/objects', account: '/account',
    mails: '/mails/off/no-such-secret', submit: '/submit', plugins: '/plugins', plugin: `/p/${plugin}`, curate: '/curate',
    campaigns: '/campaigns', campaign: `/campaigns/${campaign.id}`, stability: '/stability', 'stability-run': `/stability/${tried.id}`,
    workloads: '/workloads', workload: `/workloads/${workload}`, advisor: '/advisor', advice: `/advisor/${advice.id}`,
    about: '/about', truth: '/truth', status: '/status', api: '/api', missing: '/no/such/page',
  }
}

test('every page at three widths in both themes', async (t) => {
  const data = mkdtempSync(join(tmpdir(), 'ocb-pages-'))
  t.after(() => rmSync(data, { recursive: true, force: true }))
  const suite = join(data, 'suite.json')
  writeFileSync(suite, JSON.stringify(SUITE))
  ocb(['suite', 'run', '--data', data, '--suite-file', suite, '--machine-note', 'turbo on', ...options])
  // 3: one of them has failures.
  ocb(['stability', 'parry-f32', 'box-tree', '--seeds', '1', '--data', data, ...options], {}, 3)
  const password = addCurator(data)
  const service = await startService({ data, options: ['--suite-file', suite, '--machine-note', 'turbo off', ...options] })
  t.after(service.stop)
  const pictures = join(root, 'target/e2e/pages')
  mkdirSync(pictures, { recursive: true })
  let pages
  const found = []
  for (const scheme of SCHEMES) {
    const v = await visitor(t, { base: service.url, scheme, width: 1280 })
    await enter(v, 'curator', password)
    pages ??= await fill(v)
    for (const [name, path] of Object.entries(pages)) {
      for (const width of WIDTHS) {
        await v.page.setViewportSize({ width, height: width < 500 ? 844 : Math.round(width * 0.625) })
        await v.go(path)
        await v.page.waitForLoadState('networkidle')
        await v.page.waitForTimeout(400)
        await v.page.screenshot({ path: join(pictures, `${name}-${width}-${scheme}.png`), fullPage: true })
        try {
          // The document of the API takes axe most of a minute, once; otherwise what is around it is looked at.
          const around = name === 'api' && !(scheme === SCHEMES[0] && width === WIDTHS[0])
          await v.accessible(`${name} at ${width} px, ${scheme}`, around ? ['header', 'h1'] : [])
        } catch (error) {
          found.push(error.message)
        }
      }
    }
  }
  console.log(`${Object.keys(pages).length} pages at ${WIDTHS.join(', ')} px, ${SCHEMES.join(' and ')}: ${pictures}`)
  assert.deepEqual(found, [])
})
