// From a stock object to a picked value: builder, live page, explorer.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { choose, measured, runId, until, visitor } from '../visitor.mjs'

/** Chooses the torus knot and a set of `count` configurations, measured quickly. */
async function build(v, count) {
  await v.go('/new')
  await v.at('stock-card-torus-knot').click()
  await v.at('passes').fill('1')
  await v.at('budget').fill('3')
  await v.at('by-count').click()
  await v.at('count').fill(String(count))
  await until(`an estimate of ${count} configurations`, async () => (await v.value('estimate-configurations')) === count)
}

test('the question filters the algorithms, and number and time stand there before Start', async (t) => {
  const v = await visitor(t)
  await build(v, 150)
  const algorithms = await v.api('/algorithms')
  for (const [button, queries] of [['query-pq', ['proximity']], ['query-cd', ['collision_first', 'collision_all']]]) {
    await v.at(button).click()
    for (const a of algorithms) {
      const fits = a.queries.some((q) => queries.includes(q))
      assert.equal(await v.at(`algorithm-${a.id}`).isEnabled(), fits, `${a.id} for ${button}`)
    }
  }
  assert.ok((await v.value('estimate-seconds')) > 0)
  // By the paper's steps instead: a finer step means more configurations.
  await v.at('by-steps').click()
  await v.at('rotate').fill('20')
  await v.at('move').fill('20')
  const coarse = await until('an estimate by steps', async () => {
    const n = await v.value('estimate-configurations')
    return n > 150 && n
  })
  await v.at('move').fill('15')
  await until('more configurations', async () => (await v.value('estimate-configurations')) > coarse)
})

test('each way of finding configurations has its fields, its estimate and its command line', async (t) => {
  const v = await visitor(t)
  await build(v, 150)
  const says = (words) => until(words, async () => (await v.at('command').textContent()).includes(words))
  const estimated = () => until('an estimate', async () => (await v.value('estimate-configurations')) === 150 && v.at('start').isEnabled())
  await v.at('method-grid').click()
  await v.at('separation-step').click()
  await v.at('step').fill('-0.001')
  await says('--method grid --count 150 --step=-0.001')
  await estimated()
  await v.at('separation-ladder').click()
  await says('--method grid --count 150 --ladder')
  await estimated()
  await v.at('method-trajectory').click()
  await v.at('center-distance').fill('0.8')
  await says('--method trajectory --center-distance 0.8 --count 150')
  await estimated()
  await v.at('method-random').click()
  assert.equal(await v.at('separation-step').count(), 0, 'random placement asks for no separation')
  // What is out of range the service says, in one sentence.
  v.expectRefusal('/estimates')
  await v.at('hit-share').fill('2')
  await until('the reason', async () => (await v.at('problem').count()) && /share of colliding poses/.test(await v.at('problem').textContent()))
  assert.ok(await v.at('start').isDisabled())
  await v.at('hit-share').fill('0.25')
  await says('--method random --count 150 --hit-share 0.25')
  await estimated()
  await v.accessible('the builder with random placement')
  await v.picture('builder-random')
  await choose(v, ['box-tree', 'ocb-fast'])
  await v.at('start').click()
  const id = await runId(v.page)
  await until('the end of the run', async () => (await v.api(`/runs/${id}`)).state === 'done')
  const facts = v.page.getByRole('region', { name: 'Conditions' })
  await facts.waitFor()
  const text = await facts.textContent()
  for (const words of ['random, 150 poses, 25 % colliding', 'Coverage', 'Entropy']) assert.ok(text.includes(words), `${words} in ${text}`)
})

test('a stock object becomes a heatmap whose picked value is the API\'s', async (t) => {
  const v = await visitor(t)
  await build(v, 600)
  await v.at('query-cd').click()
  await v.at('contacts-first').click()
  // A few exact ones: each more is seven processes. That every plugin answers as it should is shown by `ocb plugin check`.
  await choose(v, ['box-tree', 'brute-force', 'bullet', 'ocb-fast', 'parry'])
  await v.at('start').click()
  const id = await runId(v.page)

  const run = await v.api(`/runs/${id}`)
  for (const stage of ['stage-object', 'stage-configurations', ...run.spec.algorithms.map((a) => `stage-measuring-${a}`), 'stage-heatmap']) {
    await v.at(stage).waitFor({ state: 'attached' })
  }
  await v.picture('live')
  await until('a picture', () => v.at('viewer-0').count())
  await until('a coloured object while it is measured', async () => (await v.colours(v.at('viewer-0'))).hues >= 2)
  const marks = [await v.at('preliminary').count(), await v.at('result-table').locator('[data-preliminary="true"]').count()]
  if ((await v.api(`/runs/${id}`)).state !== 'done') assert.ok(marks.every((n) => n > 0), `${marks} marks`)
  await v.picture('preliminary')
  await v.accessible('a run while it is measured')
  await until('the end of the run', async () => (await v.api(`/runs/${id}`)).state === 'done')
  await until('no mark', async () => (await v.at('preliminary').count()) === 0)
  await v.picture('explorer')
  // One picture of its own scale: side by side, a fast algorithm is dark beside a slow one.
  for (const slow of run.spec.algorithms.filter((a) => a !== 'box-tree')) await v.at(`show-${slow}`).uncheck()
  await until('a coloured object', async () => (await v.colours(v.at('viewer-0'))).hues >= 3)

  // The table knows all that were asked, and nothing was wrong but what is known of Bullet (plugins/cpp/KNOWN-WRONG.md).
  const done = await v.api(`/runs/${id}`)
  assert.equal(done.state, 'done')
  const table = await v.at('result-table').textContent()
  for (const r of done.results) {
    assert.ok(table.includes(r.name), `${r.name} is in the table`)
    if (r.algorithm !== 'bullet') assert.equal(r.wrong, 0, `${r.name} answered wrongly`)
    assert.equal(r.outcome.name, 'Completed')
  }

  // Picking on the object reads the value that the API gives for that vertex. Only a part of the vertices has values: where, the draw decides.
  const shares = [0.5, 0.4, 0.6, 0.35, 0.65, 0.3, 0.7]
  await until('a picked vertex with a value', async () => {
    await v.at('viewer-0').scrollIntoViewIfNeeded()
    const box = await v.at('viewer-0').boundingBox()
    for (const [x, y] of shares.flatMap((x) => shares.map((y) => [x, y]))) {
      await v.page.mouse.click(box.x + x * box.width, box.y + y * box.height)
      await v.page.waitForTimeout(300)
      if ((await v.at('pick-n').count()) && Number(await v.at('pick-n').getAttribute('data-n')) > 0) return true
    }
    return false
  })
  const chosen = (group) => v.at(group).locator('input:checked').inputValue()
  const [measure, statistic, outliers, side] = await Promise.all(['measure', 'statistic', 'outliers', 'side'].map(chosen))
  const vertex = await v.at('pick-vertex').getAttribute('data-vertex')
  const algorithm = await v.at('viewer-0').getAttribute('data-algorithm')
  const truth = await v.api(`/runs/${id}/vertices/${vertex}?algorithm=${algorithm}&side=${side}&measure=${measure}&statistic=${statistic}&outliers=${outliers}`)
  assert.equal(Number(await v.at('pick-value').getAttribute('data-value')), truth.value)
  assert.equal(Number(await v.at('pick-n').getAttribute('data-n')), truth.count)
  await v.picture('picked')
})

test('the explorer changes measure, statistic, outliers, map and scale, and downloads everything', async (t) => {
  const v = await visitor(t)
  const { id } = await measured(v)
  await v.go(`/r/${id}`)
  await v.at('viewer-0').waitFor()
  await v.at('ecdf').waitFor()
  const choices = {
    measure: ['bv_tests', 'primitive_tests', 'density', 'time'],
    statistic: ['median', 'min', 'max', 'standard_deviation', 'mad', 'mean'],
    outliers: ['keep', 'per_vertex', 'global'],
    colormap: ['viridis', 'cividis', 'turbo'],
    scale: ['log', 'linear'],
  }
  for (const [control, values] of Object.entries(choices)) {
    for (const value of values) {
      await v.at(control).locator(`input[value="${value}"]`).check({ force: true })
      await v.at('legend').first().waitFor()
    }
  }
  for (const scheme of ['light', 'dark']) {
    await v.page.emulateMedia({ colorScheme: scheme })
    await v.accessible(`the explorer, ${scheme}`)
    await v.picture(`explorer-${scheme}`)
  }
  const starts = { csv: /^configuration|^#/, parquet: /^PAR1/, glb: /^glTF/, ply: /^ply/, png: /^\x89PNG/, svg: /^<(\?xml|svg)/ }
  for (const [kind, start] of Object.entries(starts)) {
    const [download] = await Promise.all([v.page.waitForEvent('download'), v.at(`download-${kind}`).click()])
    const chunks = []
    for await (const chunk of await download.createReadStream()) chunks.push(chunk)
    assert.match(Buffer.concat(chunks).subarray(0, 40).toString('latin1'), start, `the ${kind} download`)
  }
})
