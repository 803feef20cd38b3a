// Speed against accuracy: the board and the charts of a run, compared with the API's numbers.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, visitor } from '../visitor.mjs'

/** Measures a small run through the API and waits for it. */
async function measure(v, spec) {
  const run = await v.api('/runs', { method: 'POST', data: spec })
  await until('the run to end', async () => ['done', 'failed'].includes((await v.api(`/runs/${run.id}`)).state))
  return run.id
}
const knot = (more) => ({
  object_a: 'stock:torus-knot@600', query: 'collision_first', passes: 2, budget_seconds: 5,
  method: { kind: 'sphere', sampling: { kind: 'count', count: 90 } },
  algorithms: ['box-tree', 'box-tree:leaf_size=8', 'dop-tree', 'obb-tree', 'parry', 'voxmap-pointshell', 'inner-spheres'], ...more,
})

/** What the chart on the page shows, as the API numbers it. */
const drawn = (page) =>
  page.locator('.plot .mark[data-y]').evaluateAll((marks) => marks.map((m) => ['data-x', 'data-y', 'data-n'].map((name) => m.getAttribute(name)).join(' ')).toSorted())
const given = (chart) =>
  chart.series.filter(({ form }) => form === 'line').flatMap(({ points }) => points.map(({ x, y, n }) => `${x ?? ''} ${y} ${n}`)).toSorted()
const same = (page, chart) =>
  until('the chart to show the numbers of the API', async () => JSON.stringify(await drawn(page)) === JSON.stringify(given(chart)), 15)
    .catch(async () => assert.deepEqual(await drawn(page), given(chart)))

async function taken(v, id) {
  const [download] = await Promise.all([v.page.waitForEvent('download'), v.at(id).click()])
  const chunks = []
  for await (const chunk of await download.createReadStream()) chunks.push(chunk)
  return Buffer.concat(chunks)
}

test('the board compares what was measured, filters it, and can be linked and taken away', async (t) => {
  const v = await visitor(t, { width: 1440 })
  const id = await measure(v, knot({ separation: { kind: 'ladder' } }))
  await v.go('/board?suite=none&question=collision_first&scene=torus-knot@600~torus-knot@600')
  await v.at('board-table').waitFor()
  const query = 'suite=none&question=collision_first&scene=torus-knot@600~torus-knot@600'
  const board = await v.api(`/board?${query}`)
  await same(v.page, board.chart)
  assert.equal(await v.at('finding').textContent(), board.finding)

  // The table: the rows of the API in its order, the rates those of the run.
  const run = await v.api(`/runs/${id}`)
  const rows = v.at('board-table').locator('tr[data-algorithm]')
  assert.deepEqual(await rows.evaluateAll((all) => all.map((row) => row.dataset.algorithm)), board.rows.map(({ algorithm }) => algorithm))
  for (const row of board.rows) {
    const shown = v.at('board-table').locator(`tr[data-algorithm="${row.algorithm}"]`)
    assert.equal(await shown.getAttribute('data-rank'), String(row.rank ?? ''))
    assert.equal(Number(await shown.locator('[data-rate]').getAttribute('data-rate')), row.rate?.value ?? 0)
    assert.equal(Number(await shown.locator('[data-missed]').getAttribute('data-missed')), row.missed)
    const result = run.results.find(({ algorithm }) => algorithm === row.algorithm)
    assert.equal(row.wrong, result.wrong)
    assert.ok(Math.abs(row.rate.value - 1e9 / result.time.mean_ns.value) < 1e-6 * row.rate.value, `${row.algorithm}: the rate is the run's`)
    if (row.wrong > 0) assert.equal(row.rank ?? null, null, `${row.algorithm} was wrong and has no place`)
  }
  assert.ok(board.rows.some(({ wrong }) => wrong > 0), 'what approximates is wrong somewhere on the ladder')

  // These are runs of people, and the page says so; what the suite asks stands beside it.
  await v.at('board-people').waitFor()
  await v.page.getByText(/Contents of suite \d+/).click()
  assert.match(await v.page.locator('section[aria-label=Suite] dl').textContent(), /torus-knot@4000 against itself/)

  // Colours do not depend on the width.
  for (const [width, scheme] of [[390, 'light'], [1280, 'dark'], [1440, 'light']]) {
    await v.page.setViewportSize({ width, height: 900 })
    await v.page.emulateMedia({ colorScheme: scheme })
    await v.accessible(`the board, ${width} px, ${scheme}`)
    await v.picture(`board-${width}-${scheme}`)
  }
  await v.page.emulateMedia({ colorScheme: 'light' })

  // By keyboard alone: from the precision filter to a board without those that were wrong, and back.
  await v.at('filter-precision').focus()
  await v.page.keyboard.type('no wrong')
  await v.page.waitForURL(/precision=none_seen/)
  await same(v.page, (await v.api(`/board?${query}&precision=none_seen`)).chart)
  await v.page.goBack()
  await same(v.page, board.chart)

  for (const accuracy of ['digits', 'missed', 'false_alarms']) {
    await v.at('accuracy').selectOption(accuracy)
    await v.page.waitForURL(new RegExp(`accuracy=${accuracy}`))
    await same(v.page, (await v.api(`/board?${query}&accuracy=${accuracy}`)).chart)
    await v.picture(`board-${accuracy}`)
  }
  assert.match((await taken(v, 'chart-svg')).toString('utf8'), /^<\?xml[\s\S]*<desc/)
  assert.match((await taken(v, 'chart-png')).toString('latin1'), /^\x89PNG/)
  const csv = (await taken(v, 'chart-csv')).toString('utf8').trim().split('\n')
  assert.equal(csv.length, board.rows.length + 1)
  assert.equal(JSON.parse(await taken(v, 'chart-json')).rows.length, board.rows.length)

  // A filter that leaves nothing says which it was and how to go on.
  await v.go('/board?suite=none&scene=no~such')
  await v.at('empty').waitFor()
  await v.accessible('an empty board')
  await v.picture('board-empty')
  await v.at('remove-scene').click()
  await v.at('board-table').waitFor()
  v.expectRefusal('/board')
  await v.go('/board?precision=fine')
  await v.page.getByRole('alert').first().waitFor()
})

test('every chart of a run shows the numbers of the API and is a file in four formats', async (t) => {
  const v = await visitor(t, { width: 1440 })
  const algorithms = ['box-tree', 'dop-tree', 'parry']
  await measure(v, knot({ query: 'proximity', separation: { kind: 'relative', distance: 0.1 }, algorithms }))
  const id = await measure(v, knot({ query: 'proximity', separation: { kind: 'ladder' }, algorithms }))
  await v.go(`/r/${id}`)
  await v.at('run-charts').waitFor()
  for (const kind of ['accuracy', 'resolution', 'ecdf', 'distance', 'triangles', 'bv_tests', 'primitive_tests']) {
    await v.at('chart-kind').locator(`input[value=${kind}]`).check({ force: true })
    const address = `/runs/${id}/chart?kind=${kind}&accuracy=digits`
    const chart = await v.api(address)
    await v.page.locator(`.plot[data-chart=${kind}]`).waitFor()
    await same(v.page, chart)
    await v.at('run-charts').scrollIntoViewIfNeeded()
    await v.at('run-charts').screenshot({ path: `${process.env.OCB_E2E_PICTURES}/chart-${kind}.png` })
    const points = chart.series.filter(({ form }) => form !== 'rule').flatMap((series) => series.points)
    assert.equal((await taken(v, 'chart-csv')).toString('utf8').trim().split('\n').length, points.length + 1, kind)
    assert.match((await taken(v, 'chart-parquet')).toString('latin1'), /^PAR1/)
    assert.match((await taken(v, 'chart-svg')).toString('utf8'), /<title/)
    assert.match((await taken(v, 'chart-png')).toString('latin1'), /^\x89PNG/)
  }
  for (const scheme of ['light', 'dark']) {
    await v.page.emulateMedia({ colorScheme: scheme })
    await v.accessible(`the charts of a run, ${scheme}`)
  }
})
