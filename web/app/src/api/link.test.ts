import { describe, expect, it } from 'vitest'
import { whole } from './client'
import { nextOf } from './link'

describe('where a list goes on', () => {
  it('stands in the address of the next part', () => {
    expect(nextOf('</api/v1/runs?limit=2&cursor=12%7E0193-a>; rel="next"')).toBe('12~0193-a')
    expect(nextOf('</api/v1/runs?cursor=x>; rel="prev"')).toBeNull()
    expect(nextOf('</api/v1/runs?limit=2>; rel="next"')).toBeNull()
    expect(nextOf(null)).toBeNull()
  })

  it('leads through the whole list, and ends', async () => {
    const parts: Record<string, { entries: number[]; next: string | null }> = {
      first: { entries: [5, 4], next: 'b' },
      b: { entries: [], next: 'c' },
      c: { entries: [3], next: null },
    }
    const asked: string[] = []
    const load = ({ cursor = 'first' }: { cursor?: string }) => {
      asked.push(cursor)
      return Promise.resolve(parts[cursor] ?? { entries: [], next: null })
    }
    expect(await whole(load)).toEqual([5, 4, 3])
    expect(asked).toEqual(['first', 'b', 'c'])
  })
})
