import { VueQueryPlugin } from '@tanstack/vue-query'
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest'
import { createApp, h, nextTick, type App, type Component } from 'vue'
import { createMemoryHistory, createRouter } from 'vue-router'
import { listAlgorithms } from '../api/client'
import { ApiError } from '../api/errors'
import type { ObjectHeatmap, WorkloadInfo } from '../api/types'
import { getGroup, getObjectHeatmap, getScene, getStretch, getWorkload, startWorkload } from '../api/workloads'
import WorkloadPage from '../pages/WorkloadPage.vue'
import PairMatrix from './PairMatrix.vue'
import { algorithm, pair, replay } from './sample'
import WorkloadForm from './WorkloadForm.vue'

vi.mock('../api/workloads', { spy: true })
vi.mock('../api/client', { spy: true })

let app: App | null = null
let host = document.createElement('div')
const router = createRouter({ history: createMemoryHistory(), routes: [{ path: '/:rest(.*)*', component: { render: () => null } }] })
beforeEach(() => {
  vi.mocked(listAlgorithms).mockResolvedValue([])
  const absent = new ApiError('Not in this test.', 404)
  for (const fetched of [getGroup, getObjectHeatmap, getScene, getStretch]) vi.mocked<(...given: never[]) => Promise<unknown>>(fetched).mockRejectedValue(absent)
  // happy-dom has no pointers to capture.
  Element.prototype.setPointerCapture ??= () => undefined
})
afterEach(() => app?.unmount())

async function mount(component: Component, props: Record<string, unknown>, path = '/workloads/1') {
  host = document.createElement('div')
  document.body.append(host)
  await router.push(path)
  app = createApp({ render: () => h(component, props) }).use(router).use(VueQueryPlugin, { queryClientConfig: { defaultOptions: { queries: { retry: false } } } })
  app.mount(host)
  await settle()
}
async function settle() {
  for (let i = 0; i < 5; i++) await new Promise((next) => setTimeout(next))
  await nextTick()
}
const at = (id: string) => host.querySelector<HTMLElement>(`[data-testid="${id}"]`)
const text = () => host.textContent.replace(/\s+/g, ' ')

const info = (change: Partial<WorkloadInfo>): WorkloadInfo => ({
  id: '1', spec: { algorithms: [], tracks: ['shuffled', 'recorded'], passes: 3, budget_seconds: 60, seed: null, reduce: null }, state: 'done', done: 100, total: 100, runs_ahead: 0, created_us: 1e15,
  recording: { file: 'arm.ocbrec', sha256: '', bytes: 2048, program: 'planner', libraries: ['fcl 0.7'], objects: 3, queries: 100, seen: 125 }, ...change,
})
async function page(change: Partial<WorkloadInfo>, path?: string) {
  vi.mocked(getWorkload).mockResolvedValue(info(change))
  await mount(WorkloadPage, { id: '1' }, path)
}

describe('the page of a replay', () => {
  it('waits, with its place in the queue, and can be cancelled', async () => {
    await page({ state: 'queued', done: 0, runs_ahead: 2 })
    expect(text()).toContain('2 replays ahead in the queue.')
    expect([at('workload-cancel') === null, at('workload-delete') === null]).toEqual([false, true])
    expect(host.querySelector('progress')).not.toBeNull()
  })

  it('says why it failed or was cancelled, and that there is no result', async () => {
    await page({ state: 'failed', done: 10, message: 'The disk is full.' })
    expect(host.querySelector('[role=alert]')?.textContent).toContain('The disk is full.')
    expect(text()).toContain('no result')
    expect([at('workload-json'), at('workload-cancel')]).toEqual([null, null])
    app?.unmount()
    vi.mocked(getScene).mockReturnValue(new Promise(() => undefined))
    await page({ state: 'cancelled', done: 10, message: 'Cancelled.' })
    expect(host.querySelector('[role=alert]')).toBeNull()
    expect(text()).toContain('Cancelled.')
  })

  it('is a sentence where there is no such replay', async () => {
    vi.mocked(getWorkload).mockRejectedValue(new ApiError('There is no replay "1".', 404))
    await mount(WorkloadPage, { id: '1' })
    expect(text()).toContain('This replay cannot be shown')
    expect(host.querySelector('[role=alert]')?.textContent).toContain('There is no replay "1".')
  })

  it('has the false answers before the algorithms, and none of those that were wrong in the ranking', async () => {
    const [shuffled] = replay().tracks
    const result = replay({
      tracks: [{ track: 'shuffled', algorithms: [algorithm('liar', 1, { wrong: 3, missed: 2 }), ...(shuffled?.algorithms ?? [])] }],
      recorded: {
        claims: [{ claim: 'right', count: 99 }, { claim: 'missed_collision', count: 1 }], largest_error: 0, seconds: 0.5,
        false_answers: [{ sequence: 17, objects: [0, 2], claim: 'missed_collision', answered: null, distance: [0, 0] }],
      },
    })
    await page({ result })
    expect([...host.querySelectorAll('h2')].map((head) => head.textContent).slice(0, 2)).toEqual(['What your program was told', 'Which algorithm is fastest'])
    expect(at('false-answers')?.textContent).toMatch(/17.*arm, ball.*missed collision.*no collision/)
    const rows = [...host.querySelectorAll('[data-testid=workload-algorithms] tbody tr')]
    expect(rows.map((row) => [row.getAttribute('data-algorithm'), row.getAttribute('data-ratio')])).toEqual([['fast', '1'], ['slow', '3'], ['liar', '']])
    expect(at('standing')?.textContent).toContain('FAST answers these queries fastest')
    expect(at('left-out')?.textContent).toContain('25 queries were left out: their pose is no rotation.')
    expect(at('workload-command')?.textContent).toContain('--run-seed 7')
  })

  it('says of a whole scene how it was asked, and what ended its process', async () => {
    const outcome = { name: 'Signaled' as const, signal: 11, message: 'It crashed.', ours: false }
    const scene = { track: 'scene' as const, algorithms: [algorithm('fast', 700), algorithm('slow', 0, { n: 0, total: null, groups: null, pairs: [], ended: [{ objects: null, outcome }] })] }
    await page({ result: replay({ tracks: [...replay().tracks, scene] }) })
    expect(at('asked')?.textContent).toContain('Pair by pair')
    expect(host.querySelectorAll('[data-gain]').length).toBeGreaterThan(0)
    at('order-scene')?.click()
    await settle()
    expect(at('asked')?.textContent).toContain('one process that has loaded every object once')
    expect(text()).toContain('Build: the structures of all objects, once.')
    expect(text()).toContain('on the whole scene')
    expect(host.querySelectorAll('[data-gain]')).toHaveLength(0)
  })

  it('asks for the stretch that is brushed, writes it into the link, and shows its pairs', async () => {
    vi.mocked(getStretch).mockResolvedValue({ algorithms: [{ algorithm: 'fast', track: 'shuffled', n: 25, ns: 80, wrong: 1, missed: 1, pairs: [pair([0, 2], 80)] }] })
    await page({ result: replay() })
    expect(host.querySelectorAll('[data-testid=pair-matrix] button')).toHaveLength(2)
    // 720 pixels wide, 58 of them left of the first query and 12 right of the last.
    const x = (query: number) => 58 + (650 * query) / 125
    const point = (kind: string, query: number) => at('timeline')?.dispatchEvent(new PointerEvent(kind, { clientX: x(query), button: 0, pointerId: 1 }))
    for (const [kind, query] of [['pointerdown', 95], ['pointermove', 60], ['pointerup', 60]] as const) point(kind, query)
    await settle()
    expect(getStretch).toHaveBeenLastCalledWith('1', { from: 50, to: 100 })
    expect(router.currentRoute.value.query).toEqual({ from: '50', to: '100' })
    expect(at('stretch-table')?.textContent).toMatch(/Within queries 50 to 99.*FAST25/)
    expect([...host.querySelectorAll('[data-testid=pair-matrix] button')].map((cell) => cell.getAttribute('data-value'))).toEqual(['1'])
    at('stretch-clear')?.click()
    await settle()
    expect(router.currentRoute.value.query).toEqual({})
    expect(host.querySelectorAll('[data-testid=pair-matrix] button')).toHaveLength(2)
  })
})

describe('the heatmap of an object', () => {
  const heatmap = (values: (number | null)[]): ObjectHeatmap => ({
    object: 2, request: { algorithm: 'fast', order: 'shuffled', measure: 'wrong' }, unit: 'share', values, counts: values.map((value) => (value === null ? 0 : 9)), n: 27, range: [0, 0.5],
  })

  it('is that of the link, with its legend, and writes another choice into the link', async () => {
    vi.mocked(getObjectHeatmap).mockResolvedValue(heatmap([0, 0.5, null, null]))
    await page({ result: replay() }, '/workloads/1?object=2&measure=wrong&from=50')
    expect(getObjectHeatmap).toHaveBeenLastCalledWith('1', 2, { algorithm: 'fast', order: 'shuffled', measure: 'wrong', from: 50 })
    expect(at('heat-words')?.textContent).toContain('27 queries about ball reach 2 of its 4 vertices')
    expect(at('legend')?.textContent).toMatch(/Share of wrong answers.*n = 27.*no query touched this2/)
    expect(at('heat-ply')?.getAttribute('href')).toContain('/objects/2/heatmap.ply?algorithm=fast&order=shuffled&measure=wrong&from=50')
    expect(at('heat-command')?.textContent).toContain('--object ball')
    const object = at('heat-object') as HTMLSelectElement
    object.value = '1'
    object.dispatchEvent(new Event('change'))
    await settle()
    expect(router.currentRoute.value.query).toMatchObject({ object: '1', measure: 'wrong' })
    expect(getObjectHeatmap).toHaveBeenLastCalledWith('1', 1, expect.objectContaining({ measure: 'wrong' }))
  })

  it('says what to do where the replay is too old, and the rest of the page stays', async () => {
    vi.mocked(getObjectHeatmap).mockRejectedValue(new ApiError('Replay the recording again to get heatmaps.', 422))
    await page({ result: replay() })
    expect([...host.querySelectorAll('[role=alert]')].map((one) => one.textContent)).toContainEqual(expect.stringContaining('Replay the recording again'))
    expect([at('legend'), at('heat-ply'), at('pair-matrix') === null]).toEqual([null, null, false])
  })
})

it('lights a pair of the matrix in the list of the scene, with why it is disabled', async () => {
  const scenePairs = [{ objects: [0, 1], queries: 60, disabled: null }, { objects: [1, 2], queries: 0, disabled: 'adjacent links' }]
  vi.mocked(getScene).mockResolvedValue({
    about: replay().objects, objects: [0, 1, 2].map((object) => ({ object, pose: [] })), placed_by_queries: false, pairs: scenePairs, asked: 1, disabled: 1, asked_though_disabled: 0,
  })
  await page({ result: replay() })
  expect(at('scene-words')?.textContent).toBe('1 of 3 pairs were asked. 1 is disabled; 1 is neither.')
  host.querySelector<HTMLElement>('[data-testid=pair-matrix] button')?.click()
  await settle()
  expect(router.currentRoute.value.query).toEqual({ pair: '0-1' })
  const lit = () => [...host.querySelectorAll('[data-testid=scene-pairs] tr.chosen')].map((row) => row.getAttribute('data-pair'))
  expect([lit(), at('scene-lit')?.textContent]).toEqual([['0-1'], expect.stringContaining('arm against table: asked 60 times.')])
  expect(host.querySelector('[data-testid=pair-matrix] button')?.getAttribute('aria-pressed')).toBe('true')
  host.querySelector<HTMLElement>('[data-testid=scene-pairs] [data-pair="1-2"] button')?.click()
  await settle()
  expect([lit(), at('scene-lit')?.textContent]).toEqual([['1-2'], expect.stringContaining('table against ball: disabled (adjacent links).')])
  at('scene-unlit')?.click()
  await settle()
  expect([lit(), router.currentRoute.value.query]).toEqual([[], {}])
})

it('shows a scene about which nothing was asked, without what only a replay has', async () => {
  const disabled = [{ objects: [1, 2], queries: 0, disabled: 'adjacent links' }]
  vi.mocked(getScene).mockResolvedValue({
    about: replay().objects, objects: [0, 1, 2].map((object) => ({ object, pose: [] })), placed_by_queries: false, pairs: disabled, asked: 0, disabled: 1, asked_though_disabled: 0,
  })
  await page({ total: 0, done: 0, recording: { ...info({}).recording, file: 'arm.ocbscene', queries: 0, program: '' } })
  expect(host.querySelector('h1')?.textContent).toBe('arm.ocbscene')
  expect(at('workload-progress')?.textContent).toContain('A scene without queries: there is nothing to replay.')
  expect(at('scene-words')?.textContent).toBe('3 pairs of objects. 1 is disabled.')
  expect(at('scene-pairs')?.textContent).toMatch(/table against ball\s*adjacent links$/)
  expect(at('scene-lit')?.textContent).not.toContain('matrix')
  expect(at('workload-objects')?.querySelectorAll('tbody tr').length).toBe(3)
  expect(['left-out', 'scene-asked', 'workload-command', 'again', 'workload-json'].filter(at)).toEqual([])
})

it('walks the matrix with the arrow keys, over places without a pair', async () => {
  const result = replay({ objects: ['a', 'b', 'c', 'd'].map((name) => ({ name, triangles: 1 })) })
  await mount(PairMatrix, { result, shown: 'time', pairs: [pair([0, 1], 50), pair([0, 3], 30), pair([2, 3], 20)] })
  const stop = () => host.querySelector<HTMLElement>('button[tabindex="0"]')?.getAttribute('aria-label') ?? ''
  const press = async (key: string) => {
    host.querySelector('button[tabindex="0"]')?.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }))
    await settle()
  }
  expect(stop()).toMatch(/^a against b: 10 queries, 5 collide; 50.ns \(50.%\); no wrong answers$/)
  await press('ArrowRight')
  expect(stop()).toContain('a against d')
  await press('ArrowDown')
  expect(stop()).toContain('c against d')
  await press('ArrowLeft')
  expect(stop()).toContain('c against d')
})

it('sends the recording with its spec, and shows why it was refused', async () => {
  vi.mocked(startWorkload).mockRejectedValue(new ApiError('It is a scene without queries.', 422))
  await mount(WorkloadForm, {}, '/workloads')
  const button = at('workload-start') as HTMLButtonElement
  expect(button.disabled).toBe(true)
  const drop = new Event('drop', { bubbles: true, cancelable: true })
  const file = new File(['x'], 'arm.ocbrec')
  Object.assign(drop, { dataTransfer: { files: [file] } })
  host.querySelector('.drop')?.dispatchEvent(drop)
  await settle()
  expect([button.disabled, text().includes('arm.ocbrec')]).toEqual([false, true])
  host.querySelector('form')?.dispatchEvent(new Event('submit', { cancelable: true }))
  await settle()
  expect(startWorkload).toHaveBeenCalledWith({ algorithms: [], tracks: ['shuffled', 'recorded', 'scene'], passes: 3, budget_seconds: 10, seed: null, reduce: null }, file)
  expect(at('workload-problem')?.textContent).toContain('arm.ocbrec: It is a scene without queries.')
})
