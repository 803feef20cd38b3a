import { VueQueryPlugin } from '@tanstack/vue-query'
import { afterEach, expect, it, vi } from 'vitest'
import { createApp, h, nextTick, ref, type App } from 'vue'
import { getStatus } from '../api/client'
import type { Status } from '../api/types'
import StatusPage from '../pages/StatusPage.vue'
import HardwareClassField from './HardwareClassField.vue'

vi.mock('../api/client', { spy: true })

const NEW = { hardware_class: 'new', cpu: 'CPU 2', machines: 1, queued: 3, expected_seconds: 90 }
const USUAL = { hardware_class: 'usual', cpu: 'CPU 1', machines: 2, queued: 0, expected_seconds: 0 }
const status = (classes: Status['classes']): Status => ({
  version: '1', hardware_class: 'usual', classes, running: 0, queued: 3, oldest_seconds: 5, expected_seconds: 90, idle_work: true, elsewhere: true, algorithms: 4, problems: [],
  machines: [{ name: 'alpha', state: 'waiting', seen_us: 1e15, hardware_class: 'usual' }, { name: 'beta', state: 'measuring', seen_us: 1e15, hardware_class: 'new' }],
})
let app: App | null = null
afterEach(() => app?.unmount())

async function mounted(render: () => ReturnType<typeof h>): Promise<HTMLElement> {
  const host = document.createElement('div')
  app = createApp({ render }).use(VueQueryPlugin)
  app.mount(host)
  for (let i = 0; i < 5; i++) await new Promise((next) => setTimeout(next))
  await nextTick()
  return host
}

it('lets the reader choose a class where there are several', async () => {
  vi.mocked(getStatus).mockResolvedValue(status([USUAL, NEW]))
  const chosen = ref('')
  const host = await mounted(() => h(HardwareClassField, { 'modelValue': chosen.value, 'onUpdate:modelValue': (value: string) => (chosen.value = value) }))
  const field = host.querySelector('select')
  if (!field) throw new Error('there is no choice')
  expect([...field.options].map(({ value, text }) => [value, text.trim()])).toEqual([
    ['', 'CPU 1 (usual): 2 machines, 0 waiting'], ['new', 'CPU 2 (new): 1 machine, 3 waiting'],
  ])
  field.value = 'new'
  field.dispatchEvent(new Event('change'))
  expect(chosen.value).toBe('new')
})

it('shows no choice where there is one class, but a class that a run named and nobody has any more', async () => {
  vi.mocked(getStatus).mockResolvedValue(status([USUAL]))
  expect((await mounted(() => h(HardwareClassField, { modelValue: '' }))).querySelector('select')).toBeNull()
  app?.unmount()
  const host = await mounted(() => h(HardwareClassField, { modelValue: 'gone' }))
  expect(host.querySelector('select')?.value).toBe('gone')
  expect(host.textContent).toContain('gone: no machine here')
})

it('shows the queue of each class on the status page', async () => {
  vi.mocked(getStatus).mockResolvedValue(status([USUAL, NEW]))
  const host = await mounted(() => h(StatusPage))
  const rows = [...host.querySelectorAll('[data-testid="class"]')].map((row) => row.textContent)
  expect(rows).toHaveLength(2)
  expect(rows[1]).toContain('newCPU 213')
  expect(host.querySelector('[data-testid="machine"][data-state="measuring"]')?.textContent).toContain('new')
})
