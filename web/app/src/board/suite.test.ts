import { describe, expect, it } from 'vitest'
import { describeSuite, missingWords, unfinished } from './suite'

const one = (algorithm: string, measured: number, failed = 0) => ({ algorithm, name: algorithm, measured, waiting: 0, failed, of: 4 })

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
    expect(unfinished([one('a', 4), one('b', 3), one('c', 0)]).map(({ algorithm }) => algorithm)).toEqual(['b', 'c'])
  })

  it('names missing results and says when they will be measured', () => {
    const words = (idle: boolean, ...progress: ReturnType<typeof one>[]) => missingWords({ progress, idle })
    expect(words(true, one('a', 4))).toBeNull()
    expect(words(true, one('a', 2), one('b', 3))).toBe('3 results of the suite are missing here. They will be measured when this service is idle.')
    expect(words(true, one('a', 3))).toBe('1 result of the suite is missing here. It will be measured when this service is idle.')
    expect(words(false, one('a', 3))).toMatch(/It is not measured automatically: filling the suite while idle is turned off\.$/)
    expect(words(true, one('a', 2, 2))).toBe('2 results of the suite are missing here. 2 of them could not be measured and will not be tried again automatically.')
    expect(words(true, one('a', 1, 1))).toMatch(/1 of them could not be measured and will not be tried again automatically\. The others will be measured when/)
  })
})
