import { describe, expect, it } from 'vitest'
import { readQuery, takers, withChoice } from './query'

describe('the address of the board', () => {
  it('holds the filters, and leaves out what the service chooses', () => {
    expect(readQuery({ scene: 'a~b', distance: '', nonsense: 'x', accuracy: 'digits' })).toEqual({ scene: 'a~b', accuracy: 'digits' })
    expect(readQuery({ accuracy: 'luck' })).toEqual({})
  })

  it('asks anew for what a choice decides, and keeps what it does not', () => {
    const query = { question: 'proximity', class: 'c', scene: 'a~b', distance: '0.1', precision: '1e-6' }
    expect(withChoice(query, 'scene', 'b~b')).toEqual({ question: 'proximity', class: 'c', scene: 'b~b', precision: '1e-6' })
    expect(withChoice(query, 'question', 'collision_first')).toEqual({ question: 'collision_first', precision: '1e-6' })
    expect(withChoice({ suite: '1', ...query }, 'question', 'proximity')).toEqual({ suite: '1', question: 'proximity', precision: '1e-6' })
    expect(withChoice({ suite: '1', ...query }, 'suite', 'none')).toEqual({ suite: 'none', precision: '1e-6' })
    expect(withChoice(query, 'precision', null)).toEqual({ question: 'proximity', class: 'c', scene: 'a~b', distance: '0.1' })
  })

  it('names the filters that left nothing', () => {
    const option = { value: 'none_seen', words: 'no wrong answer seen', algorithms: 0 }
    const filters = [{ name: 'scene', chosen: 'all', options: [], removed: 0 }, { name: 'precision', chosen: 'none_seen', options: [option], removed: 7 }]
    expect(takers(filters)).toEqual([{ name: 'precision', words: 'no wrong answer seen', removed: 7 }])
  })
})
