// A visitor's own file, good and bad.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { runId, until, visitor } from '../visitor.mjs'

/** A bumpy ball of about 2 * n * n triangles, as OBJ text. */
function ball(n) {
  const vertices = []
  const faces = []
  for (let i = 0; i <= n; i++) {
    for (let j = 0; j < n; j++) {
      const [u, w] = [(Math.PI * i) / n, (2 * Math.PI * j) / n]
      const r = 1 + 0.2 * Math.sin(5 * w) * Math.sin(u) ** 2
      vertices.push(`v ${r * Math.sin(u) * Math.cos(w)} ${r * Math.cos(u)} ${r * Math.sin(u) * Math.sin(w)}`)
      if (i < n) {
        const [a, b] = [i * n + j + 1, i * n + ((j + 1) % n) + 1]
        faces.push(`f ${a} ${b} ${b + n} ${a + n}`)
      }
    }
  }
  return [...vertices, ...faces].join('\n')
}

const file = (name, content) => ({ name, mimeType: 'model/obj', buffer: Buffer.from(content) })

test('an uploaded object is measured and coloured', async (t) => {
  const v = await visitor(t)
  await v.go('/new')
  await v.at('file-input').setInputFiles(file('ball.obj', ball(24)))
  await v.page.getByText('ball').first().waitFor()
  await v.at('by-count').click()
  await v.at('count').fill('60')
  await v.at('budget').fill('3')
  await until('an estimate', async () => (await v.value('estimate-configurations')) === 60)
  await v.at('query-pq').click()
  await v.at('start').click()
  await runId(v.page)
  await v.at('viewer-0').waitFor({ timeout: 120_000 })
  await until('a coloured object', async () => (await v.colours(v.at('viewer-0'))).hues >= 3)
  await v.picture('own-object')
})

const BAD = {
  'empty.obj': '',
  'junk.obj': Buffer.from(Array.from({ length: 4096 }, (_, i) => (i * 197 + 31) % 256)),
  'nan.obj': 'v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n',
  'range.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n',
  'points.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\n',
  'flat.obj': 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n',
}

test('bad files get one clear sentence and leave nothing behind', async (t) => {
  const v = await visitor(t)
  v.expectRefusal('/api/v1/objects')
  await v.go('/new')
  const before = (await v.api('/objects')).length
  const said = new Set()
  for (const [name, content] of Object.entries(BAD)) {
    await v.at('file-input').setInputFiles(file(name, content))
    const alert = v.at('file-error')
    const text = await until(`a sentence about ${name}`, async () => {
      const now = ((await alert.textContent().catch(() => '')) ?? '').trim()
      return now && !said.has(now) && now
    }, 20)
    said.add(text)
    assert.ok(text.length < 300 && !/panic|stack|undefined|Error:/.test(text), `${name}: ${text}`)
    await v.accessible(`the builder after ${name}`)
  }
  await v.picture('bad-file')
  assert.equal((await v.api('/objects')).length, before)
})

test('saved configurations are added in the builder, measured on and deleted', async (t) => {
  const v = await visitor(t)
  v.expectRefusal('/api/v1/configurations')
  await v.go('/new')
  await v.at('method-file').click()
  await v.at('saved-file').setInputFiles(file('bad.csv', '1,2,3\n'))
  await v.at('saved-error').getByText('line 1').waitFor()
  const shifts = Array.from({ length: 60 }, (_, i) => `1,0,0,${i / 20},0,1,0,0,0,0,1,0`).join('\n')
  await v.at('saved-file').setInputFiles(file('shelf.csv', shifts))
  await until('an estimate', async () => (await v.value('estimate-configurations')) === 60)
  await v.accessible('saved configurations in the builder')
  await v.picture('saved-builder')
  await v.at('start').click()
  const run = await runId(v.page)
  await until('the run is done', async () => (await v.api(`/runs/${run}`)).state === 'done')

  // Those of the run are what it was measured on, and can be chosen the same way.
  await v.go('/new')
  await v.at('method-file').click()
  await v.at('saved-run').selectOption(run)
  const { set } = await v.api(`/runs/${run}`)
  await until('they are chosen', async () => (await v.at('saved').inputValue()) === set.sha256)
  await v.go('/objects')
  await v.at('saved-configurations').getByText('shelf.csv').first().waitFor()
  await v.accessible('saved configurations on the page of objects')
  await v.picture('saved-objects')
  await v.page.getByRole('button', { name: 'Delete shelf.csv…' }).click()
  await v.at('remove-now').click()
  await until('it is gone', async () => (await v.api('/configurations')).length === 1)
})
