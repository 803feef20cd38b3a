import { afterEach, describe, expect, it } from 'vitest'
import { createApp, h, nextTick, ref, type App, type Component, type SetupContext } from 'vue'
import type { AlgorithmResult, Ecdf, SetInfo } from '../api/types'
import EcdfChart from './EcdfChart.vue'
import BuildTable from './BuildTable.vue'
import ResultTable from './ResultTable.vue'

let app: App | null = null
afterEach(() => app?.unmount())

/** Mounts a component and hands out its element and what it exposes. */
async function mount<T>(component: Component, props: Record<string, unknown>) {
  const exposed = ref<T>()
  const host = document.createElement('div')
  document.body.append(host)
  app = createApp({ render: () => h(component, { ...props, ref: exposed }) })
  app.component('RouterLink', (link: { to: string }, { slots }: Pick<SetupContext, 'slots'>) => h('a', { href: link.to }, slots.default?.()))
  app.mount(host)
  await nextTick()
  return { host, exposed }
}

describe('EcdfChart', () => {
  const curves: { name: string; curve: Ecdf }[] = ['Box <tree>', 'Parry'].map((name, i) => ({
    name,
    curve: { algorithm: name, n: 4, time_ns: [1000, 2000, 4000, 8000].map((t) => t * (i + 1)), share: [0.25, 0.5, 0.75, 1], preliminary: false },
  }))

  it('is told apart by dash, marker and colour, and read aloud', async () => {
    const { host } = await mount(EcdfChart, { curves })
    const drawn = [...host.querySelectorAll('.curve')].map((path) => path.getAttribute('stroke-dasharray'))
    expect(new Set(drawn).size).toBe(2)
    expect(host.querySelector('desc')?.textContent).toContain('Parry (dashed line, square): half of 4 queries take at most 4')
  })

  it('is a file of its own with title, description and key', async () => {
    const { exposed } = await mount<{ source: () => string }>(EcdfChart, { curves })
    const source = exposed.value?.source() ?? ''
    expect(source).toMatch(/^<\?xml[^>]+>\s*<svg[^>]+xmlns="http:\/\/www\.w3\.org\/2000\/svg"/)
    const parsed = new DOMParser().parseFromString(source.replace(/^<\?xml[^>]+>/, ''), 'image/svg+xml')
    expect(parsed.querySelector('parsererror')).toBeNull()
    for (const part of ['title', 'desc', 'path', 'text']) expect(parsed.querySelector(part)).not.toBeNull()
    expect([...parsed.querySelectorAll('text')].map((text) => text.textContent)).toContain('Box <tree>')
    expect(source).not.toMatch(/data-v-|var\(--/)
  })
})

it('marks preliminary numbers, with n and interval', async () => {
  const estimated = (value: number) => ({ value, lo: 0.9 * value, hi: 1.1 * value })
  const so_far: AlgorithmResult = {
    algorithm: 'fast', name: 'Fast', outcome: { name: 'Completed', message: '', ours: false }, n: 300, of: 5000, budget_limited: false,
    time: { median_ns: estimated(1000), p95_ns: estimated(2000), max_ns: estimated(3000), mean_ns: estimated(1000), below_resolution: 0 }, ratio: estimated(0.5),
    verdicts: [], wrong: 0, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null, preliminary: true,
  }
  const table = await mount(ResultTable, { results: [so_far] })
  const row = table.host.querySelector('tr[data-algorithm=fast][data-preliminary=true]')
  expect(row?.querySelector('td')?.textContent).toBe('–')
  const moved = await mount(ResultTable, { results: [{ ...so_far, place_so_far: 2 }] })
  expect(moved.host.querySelector('tr[data-algorithm=fast] td')?.textContent).toBe('(2)')
  expect(row?.textContent).toMatch(/300.*of 5,000.*0\.45 × – 0\.55 ×1.µs0\.9–1\.1.*preliminary/)
  app?.unmount()

  const curve = { algorithm: 'fast', n: 300, time_ns: [1000, 2000], share: [0.5, 1], preliminary: true }
  const chart = await mount(EcdfChart, { curves: [{ name: 'Fast', curve }] })
  expect(chart.host.querySelector('[data-testid=ecdf-preliminary]')?.textContent).toBe('preliminary, n = 300, shares ± 7.8 % (95 %)')
})

it('lists what failed without a place, and with the reason', async () => {
  const failed: AlgorithmResult = {
    algorithm: 'crashy', name: 'Crashy', outcome: { name: 'Signaled', message: 'It crashed with SIGSEGV.', ours: false }, n: 0, of: 9,
    budget_limited: false, time: null, verdicts: [], wrong: 0, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null, preliminary: false,
  }
  const { host } = await mount(ResultTable, { results: [failed] })
  const row = host.querySelector('tr[data-algorithm=crashy]')
  expect(row?.querySelector('td')?.textContent).toBe('–')
  expect(row?.textContent).toContain('It crashed with SIGSEGV.')
})

it('tells how each file of an algorithm was compiled, and what is not known', async () => {
  const build = { file: 'libwide.so', compilers: ['GCC: 12.2.0'], flags: ['-O3 -march=znver3'], instruction_sets: ['AVX', 'AVX2'] }
  const library = { file: 'libold.so.1', compilers: [], flags: [], instruction_sets: [] }
  const { host } = await mount(BuildTable, { algorithms: [{ id: 'wide', name: 'Wide', builds: [build, library] }, { id: 'old', name: 'Old' }] })
  const rows = [...host.querySelectorAll('[data-testid=builds] tr[data-algorithm]')].map((row) => row.textContent)
  expect(rows).toHaveLength(2)
  expect(rows[0]).toMatch(/Wide.*libwide.so.*GCC: 12.2.0.*-O3 -march=znver3.*AVX, AVX2/)
  expect(rows[1]).toMatch(/libold.so.1.*unknown.*not recorded.*x86-64 only/)
})

it('shows each unit of length, the file’s first, and names what depends on it', async () => {
  const unit = (exponent: number, value: number, wrong: number) => ({
    exponent, processes: 2, n: 9, mean_ns: { value, lo: value, hi: value }, pace: null, answers: 18, wrong, missed: 0,
  })
  const result: AlgorithmResult = {
    algorithm: 'ruler', name: 'Ruler', outcome: { name: 'Completed', message: '', ours: false }, n: 9, of: 9, budget_limited: false, time: null,
    verdicts: [], wrong: 7, bv_tests_mean: null, primitive_tests_mean: null, build_ms: null, memory_bytes: null, preliminary: false,
    by_unit: [unit(0, 1000, 0), unit(-3, 5000, 7), unit(3, 1000, 0)],
    depends_on_unit: { time: [-3], answers: [-3], message: 'Depends on the unit of length: with all coordinates times 1/8, so.' },
  }
  const { host } = await mount(ResultTable, { results: [result, { ...result, algorithm: 'old', by_unit: [], depends_on_unit: null }] })
  const rows = [...host.querySelectorAll('[data-testid=by-unit] tr[data-algorithm]')]
  expect(rows.map((row) => [row.getAttribute('data-algorithm'), row.getAttribute('data-exponent')])).toEqual([['ruler', '0'], ['ruler', '-3'], ['ruler', '3']])
  expect(rows[1]?.textContent).toMatch(/times 1\/8.*5.*µs.*7 of 18/)
  expect(host.querySelector('[data-testid=depends-on-unit]')?.textContent).toContain('Ruler: Depends on the unit of length')
  const row = host.querySelector('[data-testid=result-table] tr[data-algorithm=ruler]')
  expect(row?.textContent).toContain('none in the file’s unit')
  expect(row?.textContent).toContain('It gave wrong answers in another unit of length')
  expect(host.querySelector('[data-testid=rounding-note]')).toBeNull()

  const set = { configurations: 9, rounding: { other_answers: 2, largest_change: 0.03 } } as SetInfo
  const { host: rounded } = await mount(ResultTable, { results: [{ ...result, rounded: true }], set })
  expect(rounded.querySelector('[data-testid=rounding-note]')?.textContent).toContain('Ruler computes in single precision, got rounded coordinates')
  expect(rounded.querySelector('tr[data-algorithm=ruler] [data-testid=rounded]')?.textContent).toContain('got rounded coordinates')
})
