import { afterEach, describe, expect, it } from 'vitest'
import { createApp, h, nextTick, type App, type SetupContext } from 'vue'
import type { NoticeInfo } from '../api/types'
import NoticeList from './NoticeList.vue'
import { byReading } from './notices'

const notice = (id: string, read_us: number | null): NoticeInfo => ({
  id, subject: `about <b>${id}</b>`, text: 'first\nsecond', link: `/p/${id}`, created_us: 1_790_000_000_000_000, read_us,
})

let app: App | null = null
afterEach(() => app?.unmount())

async function mount(props: Record<string, unknown>): Promise<HTMLElement> {
  const host = document.createElement('div')
  document.body.append(host)
  app = createApp({ render: () => h(NoticeList, props as never) })
  app.component('RouterLink', (link: { to: string }, { slots }: Pick<SetupContext, 'slots'>) => h('a', { href: link.to }, slots.default?.()))
  app.mount(host)
  await nextTick()
  return host
}

describe('notices', () => {
  it('are apart by reading, each in their order', () => {
    const all = byReading([notice('c', null), notice('b', 5), notice('a', null)])
    expect(all.unread.map(({ id }) => id)).toEqual(['c', 'a'])
    expect(all.read.map(({ id }) => id)).toEqual(['b'])
  })

  it('are shown with their link, as text alone, and read or removed one by one', async () => {
    const done: string[] = []
    const host = await mount({
      notices: [notice('c', null), notice('b', 5)], more: false,
      onRead: (id: string) => done.push(`read ${id}`), onRemove: (id: string) => done.push(`remove ${id}`),
    })
    const shown = host.querySelector('[data-testid=notice]')
    expect(shown?.querySelector('a')?.getAttribute('href')).toBe('/p/c')
    expect(shown?.textContent).toContain('about <b>c</b>')
    expect(host.querySelector('b')).toBeNull()
    expect(host.querySelectorAll('[data-testid=read]')).toHaveLength(1)
    host.querySelector<HTMLElement>('[data-testid=read-notice]')?.click()
    host.querySelector<HTMLElement>('[data-testid=remove-notice]')?.click()
    expect(done).toEqual(['read c', 'remove b'])
    expect(host.querySelector('[data-testid=older-notices]')).toBeNull()
  })

  it('take no room when there are none', async () => {
    const host = await mount({ notices: [] })
    expect(host.querySelector('[data-testid=notices]')).toBeNull()
  })
})
