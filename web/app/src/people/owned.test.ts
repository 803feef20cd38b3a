import { describe, expect, it } from 'vitest'
import { inWords } from './owned'

describe('what goes, in words', () => {
  const thing = { id: 'x', name: 'x' }
  it('counts and joins', () => {
    expect(inWords({ runs: [], objects: [], configurations: [], advice: 0, stability: 0, workloads: 0, bytes: 0 })).toBe('There is nothing to delete.')
    expect(inWords({ runs: [thing], objects: [], configurations: [], advice: 0, stability: 0, workloads: 0, bytes: 0 })).toBe('1 run will be deleted permanently.')
    const all = inWords({ runs: [thing, thing], objects: [thing], configurations: [], advice: 3, stability: 1, workloads: 2, bytes: 2048 })
    expect(all).toMatch(/^2 runs, 1 object, 3 pieces of advice, 1 stability run and 2 replayed recordings will be deleted permanently, with .* of files that nothing else uses\.$/)
  })
})
