import { describe, expect, it } from 'vitest'
import type { RunSpec } from '../api/types'
import { effortOf, isLarge, rarest, whyNot, withEffort, type Effort } from './effort'

const spec: RunSpec = {
  object_a: 'stock:bunny', query: 'collision_first', method: { kind: 'sphere', sampling: { kind: 'steps', rotate: 20, move: 20 }, seed: 0 },
  algorithms: ['a', 'b'], passes: 5,
}

describe('the effort', () => {
  it('comes back from the run that it asks for', () => {
    for (const effort of ['quick', 'settled', 'whole'] as Effort[]) expect(effortOf(withEffort(spec, effort))).toBe(effort)
    expect(withEffort(spec, 'quick')).toEqual({ ...spec, at_most: 5000 })
    expect(withEffort(spec, 'settled')).toEqual({ ...spec, precision: 0.05 })
    expect(withEffort(spec, 'whole')).toBe(spec)
  })

  it('says why it is not possible', () => {
    expect(whyNot('quick', spec)).toBeNull()
    expect(whyNot('settled', spec)).toBeNull()
    expect(whyNot('settled', { ...spec, algorithms: ['a'] })).toContain('at least two algorithms')
    expect(whyNot('quick', { ...spec, algorithms: ['a'] })).toBeNull()
    expect(whyNot('settled', { ...spec, passes: 2 })).toContain('several passes')
    const trajectory: RunSpec = { ...spec, method: { kind: 'trajectory', center_distance: 1, count: 9000 } }
    expect(whyNot('quick', trajectory)).toContain('as a whole')
    expect(whyNot('whole', trajectory)).toBeNull()
  })

  it('is asked where there is something to save', () => {
    expect([undefined, 60, 5000, 5001].map(isLarge)).toEqual([false, false, false, true])
    expect([1, 5000, 194_688].map(rarest)).toEqual([1, 1666, 64_896])
  })
})
