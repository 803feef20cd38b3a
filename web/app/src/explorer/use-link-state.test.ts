import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { createApp, h, type App } from 'vue'
import { createMemoryHistory, createRouter } from 'vue-router'
import { useLinkState } from './use-link-state'

let app: App | undefined
beforeEach(() => void vi.useFakeTimers())
afterEach(() => {
  app?.unmount()
  vi.useRealTimers()
})

async function open(address: string) {
  let link: ReturnType<typeof useLinkState> | undefined
  const page = { setup: () => ((link = useLinkState()), () => h('p')) }
  const router = createRouter({ history: createMemoryHistory(), routes: [{ path: '/r/:id', component: page }] })
  await router.push(address)
  app = createApp(page).use(router)
  app.mount(document.createElement('div'))
  if (!link) throw new Error('the page was not set up')
  return { link, router }
}

it('reads the link, and says what it does not know', async () => {
  const { link } = await open('/r/1?m=bv&zz=1')
  expect(link.state.value.measure).toBe('bv_tests')
  expect(link.ignored.value).toEqual(['zz'])
})

it('shows a choice at once and makes it a step of the history', async () => {
  const { link, router } = await open('/r/1')
  link.change({ statistic: 'max' })
  expect(link.state.value.statistic).toBe('max')
  await vi.advanceTimersByTimeAsync(1)
  expect(router.currentRoute.value.fullPath).toBe('/r/1?s=max')
  link.change({ statistic: 'min' })
  await vi.advanceTimersByTimeAsync(1)
  router.back()
  await vi.advanceTimersByTimeAsync(10)
  expect(link.state.value.statistic).toBe('max')
})

it('writes what moves quickly once, when it rests, and loses none of it', async () => {
  const { link, router } = await open('/r/1')
  const replaced = vi.spyOn(router, 'replace')
  for (let i = 1; i <= 50; i++) link.change({ shown: [i / 100, 1] }, true)
  link.change({ vertex: 7 }, true)
  expect(link.state.value).toMatchObject({ shown: [0.5, 1], vertex: 7 })
  expect(replaced).not.toHaveBeenCalled()
  await vi.advanceTimersByTimeAsync(1000)
  expect(replaced).toHaveBeenCalledTimes(1)
  expect(router.currentRoute.value.query).toEqual({ rg: '0.5,1', v: '7' })
})
