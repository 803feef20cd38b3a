import { describe, expect, it } from 'vitest'
import { describeSuite, unfinished } from './suite'

describe('the suite', () => {
  it('says what it asks', () => {
    const words = describeSuite({
      scenes: [['stock:gear@4000', 'stock:gear@4000'], ['stock:box@500', 'stock:sphere@500']],
      separations: [{ kind: 'relative', distance: 0.1 }, { kind: 'step', of_size: -0.01 }, { kind: 'ladder' }],
      queries: ['collision_first', 'proximity'],
    })
    expect(words.scenes).toBe('gear@4000 against itself; box@500 against sphere@500')
    expect(words.distances).toBe('relative distance 0.1; step -1e-2 of the scene’s size; the ladder of steps, apart and crossing')
    expect(words.questions.split('; ')).toHaveLength(2)
  })

  it('knows who is not through', () => {
    const one = (algorithm: string, measured: number) => ({ algorithm, name: algorithm, measured, waiting: 0, of: 4 })
    expect(unfinished([one('a', 4), one('b', 3), one('c', 0)]).map(({ algorithm }) => algorithm)).toEqual(['b', 'c'])
  })
})
