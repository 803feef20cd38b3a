// A visitor replays a recording: uploads it, follows it, reads what was found, chooses a stretch of it, and takes the files away.
import assert from 'node:assert/strict'
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { test } from 'node:test'
import { recording } from '../recording.mjs'
import { ocb } from '../service.mjs'
import { until, visitor } from '../visitor.mjs'

/** Uploads the recording with two algorithms and so many processes each; gives the id of the replay. */
async function upload(v, file, passes = 2) {
  await v.go('/workloads')
  await v.at('workload-file').setInputFiles(file)
  await v.at('algorithm-box-tree').waitFor()
  for (const box of await v.page.locator('[data-testid^="algorithm-"]').all()) await box.uncheck()
  await v.page.getByText('Choose at least one algorithm.').waitFor()
  assert.ok(await v.at('workload-start').isDisabled())
  for (const id of ['box-tree', 'parry']) await v.at(`algorithm-${id}`).check()
  await v.at('workload-passes').fill(String(passes))
  await v.at('workload-passes').press('Enter')
  await v.page.waitForURL(/\/workloads\/[0-9a-f-]{36}/)
  return /\/workloads\/([0-9a-f-]{36})/.exec(v.page.url())[1]
}

const state = (v) => v.at('workload-progress').getAttribute('data-state')

test('a recording is replayed, read and explored', async (t) => {
  const v = await visitor(t, { width: 1920, height: 1080 })
  await v.go('/workloads')
  await v.at('workloads-empty').waitFor()
  await v.accessible('the workloads page without a replay')
  const id = await upload(v, recording())
  await until('the replay to end', async () => (await state(v)) === 'done')
  const { result } = await v.api(`/workloads/${id}`)

  // The program's false answers come first.
  const sections = await v.page.locator('main h2').allTextContents()
  assert.equal(sections[0], 'What your program was told')
  for (const { claim, count } of result.recorded.claims.filter(() => result.recorded.false_answers.length > 0))
    assert.equal(await v.at('recorded').locator(`[data-claim="${claim}"]`).getAttribute('data-count'), String(count))

  // One row per algorithm; the fastest has the ratio 1, and those that were wrong have none.
  const rows = v.at('workload-algorithms').locator('tbody tr')
  assert.equal(await rows.count(), result.tracks[0].algorithms.length)
  for (const { algorithm, wrong } of result.tracks[0].algorithms.filter((one) => one.wrong > 0))
    assert.equal(await v.at('workload-algorithms').locator(`[data-algorithm="${algorithm}"]`).getAttribute('data-ratio'), '', `${wrong} wrong`)

  // The matrix has each pair once, and is walked with the arrow keys.
  const cells = v.at('pair-matrix').locator('button')
  assert.equal(await cells.count(), result.tracks[0].algorithms[0].pairs.length)
  const shares = await cells.evaluateAll((all) => all.map((one) => Number(one.dataset.value)))
  assert.ok(Math.abs(shares.reduce((sum, share) => sum + share, 0) - 1) < 1e-9)
  await v.at('pair-matrix').locator('button[tabindex="0"]').focus()
  const first = await v.at('pair-reading').textContent()
  for (const key of ['ArrowRight', 'ArrowDown']) await v.page.keyboard.press(key)
  if ((await cells.count()) > 1) assert.notEqual(await v.at('pair-reading').textContent(), first)
  for (const shown of ['hits', 'wrong', 'time']) await v.at(`show-${shown}`).check()
  await v.accessible('the page of a replay')
  await v.picture('workload')

  // A stretch is brushed, is in the link, and narrows the matrix; the page shows the values of the service.
  await v.at('timeline').scrollIntoViewIfNeeded()
  const box = await v.at('timeline').boundingBox()
  await v.page.mouse.move(box.x + 0.3 * box.width, box.y + 80)
  await v.page.mouse.down()
  await v.page.mouse.move(box.x + 0.6 * box.width, box.y + 90, { steps: 4 })
  await v.page.mouse.up()
  await v.at('stretch-table').waitFor()
  const link = new URL(v.page.url())
  assert.match(link.search, /from=\d+/)
  const within = await v.api(`/workloads/${id}/stretch${link.search}`)
  const [{ algorithm, track, n }] = within.algorithms
  assert.equal(track, result.tracks[0].track)
  assert.match(await v.at('stretch-table').locator(`[data-algorithm="${algorithm}"]`).textContent(), new RegExp(n.toLocaleString('en-GB')))
  assert.ok(n < result.tracks[0].algorithms.find((one) => one.algorithm === algorithm).n)
  await v.accessible('a stretch of a replay')
  await v.picture('workload-stretch')
  await v.page.reload()
  await v.at('stretch-table').waitFor()
  await v.at('stretch-clear').click()
  await until('the whole recording', async () => (await v.at('stretch-table').count()) === 0)
  assert.equal(new URL(v.page.url()).searchParams.get('from'), null)
  // The same by numbers, for the keyboard.
  await v.at('stretch-first').fill('9')
  await v.at('stretch-last').fill('3')
  await v.at('stretch-last').press('Enter')
  await v.page.getByText('The first query must not be behind the last one.').waitFor()
  await v.at('stretch-last').fill('12')
  await v.at('stretch-last').press('Enter')
  await v.page.waitForURL(/from=9&to=13/)

  const files = []
  v.page.on('download', (file) => files.push(file.suggestedFilename()))
  for (const name of ['workload-json', 'workload-parquet', 'workload-recording', 'timeline-svg']) await v.at(name).click()
  await until('the files', () => files.length === 4)
  assert.match(await v.at('workload-command').textContent(), new RegExp(`--run-seed ${result.seed}`))
})

test('a robot is looked at before anything is asked about it', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'ocb-robot-'))
  t.after(() => rmSync(folder, { recursive: true, force: true }))
  const link = (name, shape) => `<link name="${name}"><collision><geometry>${shape}</geometry></collision></link>`
  const joint = (a, b, z) => `<joint name="${b}" type="fixed"><parent link="${a}"/><child link="${b}"/><origin xyz="0 0 ${z}"/></joint>`
  writeFileSync(join(folder, 'arm.urdf'), `<robot name="arm">${link('base', '<box size="1 1 0.4"/>')}${link('arm', '<cylinder radius="0.2" length="1"/>')}${link('hand', '<sphere radius="0.3"/>')}${joint('base', 'arm', 0.7)}${joint('arm', 'hand', 0.7)}</robot>`)
  ocb(['scene', 'import', join(folder, 'arm.urdf'), '--out', join(folder, 'arm.ocbscene')])

  const v = await visitor(t)
  await v.go('/workloads')
  await v.at('workload-file').setInputFiles(join(folder, 'arm.ocbscene'))
  await v.at('workload-is-scene').waitFor()
  assert.equal(await v.page.locator('[data-testid^="algorithm-"]').count(), 0, 'nothing is chosen')
  await v.at('workload-start').click()
  await v.at('scene-words').waitFor()
  assert.equal(await state(v), 'done')
  assert.equal(await v.at('scene-words').textContent(), '3 pairs of objects. 2 are disabled.')
  assert.equal(await v.at('scene-stage').getAttribute('data-objects'), '3')
  await until('a coloured scene', async () => (await v.colours(v.at('scene-stage'))).coloured > 500)
  const before = await v.colours(v.at('scene-stage'))
  await v.at('scene-pairs').locator('[data-pair="0-1"] button').click()
  assert.match(await v.at('scene-lit').textContent(), /disabled \(adjacent/)
  await until('the pair in its colour', async () => Object.keys((await v.colours(v.at('scene-stage'))).each).some((hue) => !(hue in before.each)))
  await v.accessible('a scene without queries')
  await v.picture('scene-alone')
  const [file] = await Promise.all([v.page.waitForEvent('download'), v.at('workload-recording').click()])
  assert.equal(file.suggestedFilename(), 'arm.ocbscene')
  await v.at('workload-delete').click()
  await v.at('workload-delete-now').click()
  await v.page.waitForURL(/\/workloads$/)
})

test('a heatmap shows where on an object its queries are, and the scene shows the pair that is chosen', async (t) => {
  const v = await visitor(t, { width: 1280, height: 1000 })
  const id = await upload(v, recording(), 1)
  await until('the replay to end', async () => (await state(v)) === 'done')
  const { result } = await v.api(`/workloads/${id}`)

  // Object, algorithm, order and measure by keyboard; each is in the link.
  await v.at('heat-object').selectOption('table')
  await v.page.waitForURL(/object=1/)
  await v.at('heat-algorithm').selectOption('box-tree')
  await v.at('heat-order-recorded').focus()
  await v.page.keyboard.press('Space')
  await v.page.waitForURL(/order=recorded/)
  await v.at('heat-queries').focus()
  await v.page.keyboard.press('Space')
  await v.page.waitForURL(/measure=queries/)
  const query = 'algorithm=box-tree&order=recorded&measure=queries'
  const map = await v.api(`/workloads/${id}/objects/1/heatmap?${query}`)
  const asked = result.tracks[0].algorithms[0].pairs.filter(({ objects }) => objects.includes(1)).reduce((sum, { n }) => sum + n, 0)
  assert.equal(map.n, asked, 'all queries that the table takes part in')
  await until('the words of this heatmap', async () => (await v.at('heat-words').textContent()).startsWith(`${map.n} queries about table`))
  await v.at('heat-stage').locator('[data-ready=true]').waitFor()
  // Some of the faces are never near; their corners say so, in the legend as well.
  const none = map.values.filter((value) => value === null).length
  assert.match(await v.at('legend').textContent(), new RegExp(`n = ${map.n}.*no query touched this${none}`))
  await until('colours', async () => (await v.colours(v.at('heat-stage'))).coloured > 2000)

  // A vertex is read by its number, and by the middle of the picture.
  const top = map.values.indexOf(map.range[1])
  await v.at('pick-vertex').fill(String(top))
  await v.at('pick-vertex').press('Enter')
  await until('the value', async () => (await v.value('pick-value')) === map.range[1])
  await v.at('heat-stage').getByTestId('viewer-0').focus()
  await v.page.keyboard.press('ArrowLeft')
  await v.page.keyboard.press('Enter')
  const read = Number(await v.at('pick-vertex').getAttribute('data-vertex'))
  if (map.values[read] !== null) assert.equal(await v.value('pick-value'), map.values[read])
  else assert.match(await v.at('pick-value').textContent(), /no query touched this/)
  await v.page.reload()
  await until('the same heatmap', async () => (await v.at('heat-words').textContent()).startsWith(`${map.n} queries about table`))

  // The command line makes the same table from the files of the page.
  const [bytes, csv] = await Promise.all(['queries.parquet', `objects/1/heatmap.csv?${query}`].map(async (file) =>
    (await v.context.request.get(`${new URL(v.page.url()).origin}/api/v1/workloads/${id}/${file}`)).body()))
  const folder = dirname(recording())
  writeFileSync(join(folder, `workload-${id}.parquet`), bytes)
  const command = await v.at('heat-command').textContent()
  const words = command.replaceAll('\\\n', ' ').split(/\s+/).slice(1, -1)
  const made = join(folder, 'heatmap.csv')
  ocb([...words.map((word) => (/\.(ocbrec|parquet)$/.test(word) ? join(folder, word) : word)), made])
  assert.equal(readFileSync(made, 'utf8'), csv.toString())
  const files = []
  v.page.on('download', (file) => files.push(file.suggestedFilename()))
  for (const end of ['glb', 'ply', 'csv']) await v.at(`heat-${end}`).click()
  await until('the files', () => files.length === 3)

  // A pair of the matrix is lit in the scene, which has all objects.
  await v.at('scene-stage').scrollIntoViewIfNeeded()
  assert.equal(await v.at('scene-stage').getAttribute('data-objects'), '3')
  assert.match(await v.at('scene-words').textContent(), /3 of 3 pairs were asked\. The recording disables none/)
  const before = await v.colours(v.at('scene-stage'))
  await v.at('pair-matrix').locator('button[tabindex="0"]').focus()
  await v.page.keyboard.press('Enter')
  await v.page.waitForURL(/pair=\d-\d/)
  const pair = new URL(v.page.url()).searchParams.get('pair')
  assert.equal(await v.at('scene-pairs').locator('tr.chosen').getAttribute('data-pair'), pair)
  assert.equal(await v.at('pair-matrix').locator('button[aria-pressed="true"]').count(), 1)
  await until('the pair in its colour', async () => Object.keys((await v.colours(v.at('scene-stage'))).each).some((hue) => !(hue in before.each)))
  await v.accessible('a replay with a heatmap and a chosen pair')
  await v.at('heat-stage').scrollIntoViewIfNeeded()
  await v.picture('workload-heatmap')
  await v.at('scene-stage').scrollIntoViewIfNeeded()
  await v.picture('workload-scene')
})

test('a replay is asked for again and deleted on a telephone', async (t) => {
  const v = await visitor(t, { scheme: 'dark', width: 390 })
  const first = await upload(v, recording())
  await until('the replay to end', async () => (await state(v)) === 'done')
  await v.accessible('a replay on a telephone')
  await v.picture('workload-390')
  await v.at('again').locator('summary').first().click()
  await v.at('again').getByTestId('orders-recorded').check()
  // The simplest scene is asked for as well.
  await v.at('again').getByTestId('reduce').check()
  await v.at('reduce-tolerance').fill('0')
  await v.page.getByText('The tolerance must be above 0.').waitFor()
  await v.at('reduce-tolerance').fill('0.1')
  await v.at('reduce-outside').check()
  await v.at('reduce-frontier').check()
  await v.accessible('the form of another replay')
  await v.at('again-start').click()
  await until('the other replay', () => !v.page.url().includes(first))
  const second = v.page.url().split('/').at(-1)
  assert.deepEqual((await v.api(`/workloads/${second}`)).spec.tracks, ['recorded'])
  await until('the other replay to end', async () => (await state(v)) === 'done')
  const { reduced } = (await v.api(`/workloads/${second}`)).result
  assert.ok(reduced.outside_only && reduced.objects.length > 0 && reduced.speed.length === 2)
  const objects = v.at('reduced').getByTestId('reduced-object')
  assert.deepEqual((await objects.evaluateAll((all) => all.map((one) => one.dataset.body))).toSorted(), reduced.objects.map(({ body }) => body).toSorted())
  assert.match(await v.at('reduced-certified').textContent(), /no collision is missed/)
  assert.match(await v.at('reduce-command').textContent(), /ocb scene reduce .*--tolerance 0\.1 .*--outside-only/s)
  assert.ok(reduced.frontier.series[0].points.length === 8, 'the objects and seven tolerances')
  await v.at('frontier').scrollIntoViewIfNeeded()
  await v.accessible('a reduced scene on a telephone')
  await v.picture('workload-reduced-390')
  const files = []
  v.page.on('download', (file) => files.push(file.suggestedFilename()))
  await v.at('reduced-file').click()
  await until('the reduced recording', () => files.some((name) => name.endsWith('-reduced.ocbrec')))

  for (const id of [second, first]) {
    await v.go(`/workloads/${id}`)
    await v.at('workload-delete').click()
    await v.at('workload-delete-now').click()
    await v.page.waitForURL(/\/workloads$/)
  }
  await v.at('workloads-empty').waitFor()
  v.expectRefusal(`/workloads/${first}`)
  v.expectRefusal('404')
  await v.go(`/workloads/${first}`)
  await v.page.getByText('This replay cannot be shown').waitFor()
  await v.accessible('a replay that is gone')
})

test('a replay is cancelled and leaves no result', async (t) => {
  const v = await visitor(t)
  // So many processes that it is not done before it is cancelled.
  const id = await upload(v, recording(), 64)
  await v.at('workload-cancel').click()
  await until('the replay to be cancelled', async () => (await state(v)) === 'cancelled')
  await v.page.getByText('so there is no result').waitFor()
  await v.accessible('a cancelled replay')
  await v.go('/workloads')
  await v.at('workloads').locator(`[data-workload="${id}"]`).getByText('cancelled').waitFor()
})

test('a file that is not a recording is refused with the reason', async (t) => {
  const v = await visitor(t)
  v.expectRefusal('/api/v1/workloads')
  v.expectRefusal('status of 4')
  await v.go('/workloads')
  await v.at('workload-file').setInputFiles({ name: 'notes.ocbrec', mimeType: 'application/zip', buffer: Buffer.from('no archive') })
  await v.at('workload-start').click()
  await v.at('workload-problem').waitFor()
  assert.match(await v.at('workload-problem').textContent(), /notes\.ocbrec/)
  assert.match(v.page.url(), /\/workloads$/)
  await v.accessible('a refused recording')
})
