import { describe, expect, it } from 'vitest'
import type { RecordedAnswers } from '../api/types'
import { replay } from './sample'
import { claims, libraryWords, pairName, progressWords, recordedWords, scopeWords, titleOf } from './words'

const recorded = (of: RecordedAnswers['claims']): RecordedAnswers => ({ claims: of, largest_error: 0, false_answers: [] })

describe('the program’s own answers', () => {
  it('are told with the false ones first, the worst before the others', () => {
    const all = recorded([
      { claim: 'right', count: 990 }, { claim: 'undecided', count: 3 }, { claim: 'distance_over', count: 5 }, { claim: 'missed_collision', count: 2 },
    ])
    expect(claims(all).map(({ claim }) => claim)).toEqual(['missed_collision', 'distance_over', 'undecided', 'right'])
    expect(recordedWords(all)).toBe('7 of the 1,000 answers that the program got are false. 3 cannot be decided.')
  })

  it('are plain when none is false or there is none', () => {
    expect(recordedWords(recorded([{ claim: 'right', count: 12 }]))).toBe('None of the 12 answers that the program got is false.')
    expect(recordedWords(recorded([]))).toContain('nothing to judge')
  })

  it('took a time that belongs to the other machine', () => {
    expect(libraryWords(recorded([]), ['fcl'])).toBeNull()
    expect(libraryWords({ ...recorded([]), seconds: 0.25 }, ['fcl 0.7', 'coal 3'])).toMatch(/fcl 0.7, coal 3 took 250.ms, as recorded on that machine; .*not comparable/)
    expect(libraryWords({ ...recorded([]), seconds: 12.3 }, [])).toMatch(/its library took 12\.3.s/)
  })
})

it('tells how far a replay is', () => {
  const at = (state: 'queued' | 'running' | 'cancelled', ahead = 0) => progressWords({ state, runs_ahead: ahead, done: 1200, total: 5000 })
  expect([at('queued'), at('queued', 1), at('queued', 2)]).toEqual(['Next replay in the queue.', '1 replay ahead in the queue.', '2 replays ahead in the queue.'])
  expect([at('running'), at('cancelled')]).toEqual(['1,200 of 5,000 queries replayed.', '1,200 of 5,000 queries replayed.'])
})

it('names a recording by its program, or by its file', () => {
  const recording = { file: 'my.ocbrec', sha256: '', bytes: 1, program: '', libraries: [], objects: 1, queries: 1, seen: 1 }
  expect(titleOf({ recording })).toBe('my.ocbrec')
  expect(titleOf({ recording: { ...recording, program: 'planner' } })).toBe('planner')
})

it('says what was replayed', () => {
  expect(scopeWords(replay())).toBe('100 of 125 queries in 10 groups about 3 objects, 1 of them primitives; 50\u202f% collide. 3 processes per algorithm, order and pair.')
  expect(pairName(replay(), [2, 9])).toBe('ball against object 9')
})
