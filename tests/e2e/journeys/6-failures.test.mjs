// Where methods fail: heatmaps of failure, differences, brushing both ways, the worst configurations.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, visitor } from '../visitor.mjs'

// So near that parry in single precision gets some answers wrong, though its arithmetic could tell: some 220 of 400 or
// some 390, as the equivalent instances fall.
const SPEC = {
  object_a: 'stock:torus-knot@2000', query: 'collision_first', separation: { kind: 'step', of_size: 2e-3 }, passes: 1, budget_seconds: 10,
  algorithms: ['box-tree', 'parry-f32'],
  method: { kind: 'sphere', seed: 6, sampling: { kind: 'count', count: 400 } },
}

async function failing(v) {
  const answer = await v.context.request.post(`${process.env.OCB_E2E_URL}/api/v1/runs`, { data: SPEC })
  assert.ok(answer.ok(), await answer.text())
  const { id } = await answer.json()
  return until('the run', async () => {
    const run = await v.api(`/runs/${id}`)
    return run.state === 'done' && run
  })
}

const selection = (v, id, algorithm, where) => v.api(`/runs/${id}/selection?${new URLSearchParams({ algorithm, where })}`)
const selected = (v) => v.value('selection-count')
/** The count beside the selections becomes the API's for what the list says. */
async function agrees(v, id, algorithm) {
  const where = await v.at('selection').locator('li code').allTextContents()
  const { n } = await selection(v, id, algorithm, where.map((text) => `(${text})`).join(' & '))
  await until(`${n} selected`, async () => (await selected(v)) === n)
  return n
}

test('failures stand on the object, zero as zero, and are subtracted, brushed, listed and posed', async (t) => {
  const v = await visitor(t, { width: 1440, height: 1000 })
  const run = await failing(v)
  const wrong = run.results.find(({ algorithm }) => algorithm === 'parry-f32').wrong
  assert.ok(wrong > 0 && wrong < run.set.configurations)

  await v.go(`/r/${run.id}?m=wrong&c=viridis`)
  await until('words', async () => (await v.at('failure-words').count()) && /parry.*above 0 at/i.test(await v.at('failure-words').textContent()))
  assert.match(await v.at('failure-words').textContent(), /BoxTree: 0 at all/)
  assert.match(await v.at('legend').textContent(), /Wrong answers, share.*n = /)
  // What is 0 everywhere is drawn in the colour of 0, not as missing.
  await until('the colour of zero', async () => (await v.colours(v.at('viewer-0'))).coloured > 500)
  assert.ok((await v.colours(v.at('viewer-1'))).hues >= 2)
  await v.picture('failures-wrong')

  for (const measure of ['missed', 'false_alarms', 'flips', 'disagreement']) {
    await v.at('measure').locator(`input[value="${measure}"]`).check({ force: true })
    await until(`the words of ${measure}`, async () => (await v.at('failure-words').count()) > 0)
  }
  assert.ok(await v.at('measure').locator('input[value="distance_error"]').isDisabled(), 'collisions have no distance error')

  // The value at a vertex of a difference is that of the API.
  await v.at('measure').locator('input[value="time"]').check({ force: true })
  await v.at('against').selectOption('box-tree')
  await until('one difference', async () => (await v.at('viewer-0').textContent()).includes('−') && (await v.at('viewer-1').count()) === 0)
  await until('its legend', async () => /difference/.test(await v.at('legend').textContent()))
  const map = await v.api(`/runs/${run.id}/heatmap?algorithm=parry-f32&measure=time&statistic=median&outliers=per_vertex&against=box-tree`)
  const vertex = map.values.findIndex((value) => value !== null)
  await v.at('pick-vertex').fill(String(vertex))
  await v.at('pick-vertex').press('Enter')
  await until('the value', async () => (await v.value('pick-value')) === map.values[vertex])
  assert.match(await v.at('download-glb').getAttribute('href'), /against=box-tree/)
  await v.picture('failures-difference')
  await v.at('against').selectOption('')

  // A rectangle in the chart is a selection, whose members the API counts alike, and which lights its region.
  await v.at('brush-frame').scrollIntoViewIfNeeded()
  const box = await v.at('brush-frame').boundingBox()
  await v.page.mouse.move(box.x + box.width * 0.35, box.y + 20)
  await v.page.mouse.down()
  await v.page.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.6, { steps: 4 })
  await v.page.mouse.up()
  assert.ok((await agrees(v, run.id, 'box-tree')) > 0)
  await v.at('ecdf-lit').first().waitFor({ state: 'attached' })
  await v.page.evaluate(() => scrollTo(0, 0))
  await v.page.waitForTimeout(300)
  await v.picture('failures-brush')

  // A ball around the place in the middle of the picture, by keyboard; both hold together. Undo takes it back.
  await v.at('viewer-0').focus()
  await v.page.keyboard.press('b')
  await until('a second selection', async () => (await v.at('selection-name-1').count()) === 1)
  await agrees(v, run.id, 'box-tree')
  await v.at('selection-undo').click()
  await until('one selection', async () => (await v.at('selection-name-1').count()) === 0)
  await v.at('selection-remove-0').click()
  await until('no selection', async () => (await v.at('selection-name-0').count()) === 0)

  // A double click is a ball, too; renamed, it is still there after coming back by the link.
  await v.page.evaluate(() => scrollTo(0, 0))
  const picture = await v.at('viewer-0').boundingBox()
  await until('a ball', async () => {
    for (const [x, y] of [[0.2, 0.35], [0.5, 0.22], [0.75, 0.45], [0.5, 0.35], [0.4, 0.5]]) {
      await v.page.mouse.dblclick(picture.x + x * picture.width, picture.y + y * picture.height)
      await v.page.waitForTimeout(200)
      if (await v.at('selection-name-0').count()) return true
    }
    return false
  })
  await v.at('selection-name-0').fill('a ball of mine')
  await v.at('selection-name-0').press('Enter')
  const n = await agrees(v, run.id, 'box-tree')
  await v.page.waitForTimeout(500)
  await v.page.reload()
  await until('the same selection', async () => (await selected(v)) === n)
  assert.equal(await v.at('selection-name-0').inputValue(), 'a ball of mine')
  await v.at('selection-remove-0').click()

  // What is written by hand: wrong answers, and a sentence for what cannot be read.
  v.expectRefusal('where=wrong%20of%20parry-f32%20%26')
  await v.at('selection-where').fill('wrong of parry-f32 &')
  await v.at('selection-add').click()
  assert.match(await v.at('selection-refusal').textContent(), /character 21/)
  await v.at('selection-where').fill('wrong of parry-f32')
  await v.at('selection-add').click()
  await until('the wrong ones', async () => (await selected(v)) === wrong)

  // The worst come wrong ones first, and are posed.
  await v.at('show-box-tree').uncheck()
  const rows = v.at('worst').locator('tbody tr')
  await until('the worst of parry', async () => (await rows.count()) === Math.min(100, wrong))
  assert.equal(await rows.first().getAttribute('data-verdict'), 'false_positive')
  await rows.nth(1).getByRole('button').press('Enter')
  await until('what meets', async () => (await v.value('pair-meeting')) === 0)
  assert.match(await v.at('pair-claim').textContent(), /^the answer names triangles \d+ of A and \d+ of B$/)
  await until('the pair', async () => (await v.colours(v.at('pair'))).coloured > 300)
  await v.at('worst').scrollIntoViewIfNeeded()
  await v.picture('failures-worst')
  // Closer, the claimed triangles are seen.
  const PURPLE = 31
  const claimed = async () => (await v.colours(v.at('pair'))).each[PURPLE] ?? 0
  const far = await claimed()
  await v.at('pair-close').press('Enter')
  await until('the claim', async () => (await claimed()) > far + 100)
  await v.picture('failures-close')
  for (const scheme of ['light', 'dark']) {
    await v.page.emulateMedia({ colorScheme: scheme })
    await v.accessible(`failures, ${scheme}`)
    await v.picture(`failures-${scheme}`)
  }
  await v.page.setViewportSize({ width: 390, height: 844 })
  await v.accessible('failures on a telephone')
})
