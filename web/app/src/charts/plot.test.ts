import { afterEach, describe, expect, it } from 'vitest'
import { createApp, h, nextTick, ref, type App } from 'vue'
import type { Chart, ChartPoint } from '../api/types'
import { aloud, keys, names, overlap, path, plot, below } from './plot'
import PlotChart from './PlotChart.vue'

const point = (x: number | null, y: number, more: Partial<ChartPoint> = {}): ChartPoint => ({
  name: null, x, x_lo: null, x_hi: null, y, y_lo: y * 0.9, y_hi: y * 1.1, n: 40, filled: true, at_least: false, missed: 0, false_alarms: 0, words: '', ...more,
})
const chart: Chart = {
  kind: 'board', title: 'Speed & accuracy', finding: 'A is fastest.', notes: [], preliminary: false,
  x: { label: 'wrong answers', unit: 'share', scale: 'log', lane: 'none seen (< 7.5e-2 at 95 %)' },
  y: { label: 'questions per second', unit: '1/s', scale: 'log', lane: null },
  series: [
    { name: 'boxes', style: 0, form: 'line', points: [point(null, 2e4, { name: 'A <b>', words: 'A: 20,000.' }), point(1e-3, 4e4, { name: 'A 2', filled: false, missed: 3, false_alarms: 2 })] },
    { name: 'boxes', style: 0, form: 'line', points: [point(1e-2, 8e4)] },
    { name: 'frontier', style: null, form: 'rule', points: [point(null, 2e4), point(1e-2, 8e4)] },
  ],
}
const BOX = { left: 60, right: 660, top: 10, bottom: 310 }

let app: App | null = null
afterEach(() => app?.unmount())

async function mount(of: Chart) {
  const exposed = ref<{ source: () => string }>()
  const host = document.createElement('div')
  document.body.append(host)
  app = createApp({ render: () => h(PlotChart, { chart: of, ref: exposed }) })
  app.mount(host)
  await nextTick()
  return { host, exposed }
}

describe('a chart', () => {
  it('draws every number of the API, and no other', async () => {
    const { host } = await mount(chart)
    const drawn = [...host.querySelectorAll('.mark[data-y]')].map((mark) => ['data-x', 'data-y', 'data-n'].map((name) => mark.getAttribute(name)))
    const given = chart.series.filter(({ form }) => form === 'line').flatMap(({ points }) => points.map(({ x, y, n }) => [x ?? '', y, n].map(String)))
    expect(drawn).toEqual(given)
    expect(host.querySelectorAll('.bar').length).toBe(3)
    expect(host.querySelectorAll('.mark[data-y].hollow').length).toBe(1)
  })

  it('says missed collisions and false alarms apart', async () => {
    const { host } = await mount(chart)
    expect(host.querySelector('tspan.missed')?.textContent).toBe('3 missed')
    expect(host.querySelector('tspan.alarms')?.textContent).toBe('2 false alarms')
  })

  it('is a file of its own with title and description', async () => {
    const { exposed } = await mount(chart)
    const source = exposed.value?.source() ?? ''
    const parsed = new DOMParser().parseFromString(source.replace(/^<\?xml[^>]+>/, ''), 'image/svg+xml')
    expect(parsed.querySelector('parsererror')).toBeNull()
    expect(parsed.querySelector('desc')?.textContent).toContain('A: 20,000.')
    expect(source).not.toMatch(/data-v-|var\(--/)
  })

  it('has one row per name in its key, without the lines that guide the eye', () => {
    expect(keys(chart)).toEqual([{ name: 'boxes', style: 0, form: 'line', n: 120 }])
    expect(aloud(chart)).toContain('A is fastest.')
  })

  it('breaks its line where a signed axis changes sides', () => {
    const signed: Chart = { ...chart, x: { ...chart.x, scale: 'signed', lane: null }, series: [{ name: 'a', style: 0, form: 'line', points: [point(-1e-2, 1), point(-1e-3, 1), point(1e-3, 1), point(1e-2, 1)] }] }
    const [line] = signed.series
    expect(line && path(signed, line, plot(signed, BOX)).match(/M/g)?.length).toBe(2)
  })

  it('gives close marks names that do not touch, and none where there is no room', () => {
    const placed = names([[100, 100], [104, 102], [650, 100]].map(([x = 0, y = 0]) => ({ x, y, letters: 8, arrow: false })), BOX)
    const rects = placed.flatMap((at) => (at ? [{ left: at.x, right: at.x + 8 * 6.6, top: at.y - 10, bottom: at.y + 3 }] : []))
    expect(rects.length).toBe(3)
    for (const [i, a] of rects.entries()) for (const b of rects.slice(i + 1)) expect(overlap(a, b)).toBe(false)
    expect(names([{ x: 100, y: 100, letters: 500, arrow: false }], BOX)).toEqual([null])
    const [plain, pointing] = [false, true].map((arrow) => names([{ x: 100, y: 100, letters: 8, arrow }], BOX)[0])
    expect([plain?.x, pointing?.x]).toEqual([110, 124])
  })

  it('keeps the words of an axis inside and off the lane', () => {
    const ticks = [{ at: 0.1, text: '1e-4' }, { at: 0.5, text: '1 %' }, { at: 1, text: '100 %' }]
    expect(below(ticks, BOX, 900, 0).map(({ x }) => x)).toEqual([120, 360, 660])
    expect(below(ticks, BOX, 665, 110)).toEqual([{ text: '1 %', x: 360 }, { text: '100 %', x: 648.5 }])
  })
})
