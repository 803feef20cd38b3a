import { describe, expect, test } from 'vitest'
import type { Stability, StabilityRunInfo } from '../api/types'
import { choices, partsOf, progressWords, tested, untestedWords } from './choice'

const family = (id: string, name: string) => ({ id, name, sentence: '', source: '', parameter: 'x', continuous: false, harder: 'large' as const, beyond: false })
const table = { families: [family('near', 'Near'), family('far', 'Far')], relations: [{ id: 'swap', name: 'Swap', sentence: '' }, { id: 'unit', name: 'Unit', sentence: '' }] }
const run: StabilityRunInfo = {
  id: 'x', spec: { algorithm: 'a' }, name: 'A', state: 'queued', step: 'near', done: 0, total: 2, runs_ahead: 2, created_us: 0,
}

describe('what a stability run tests', () => {
  test('every choice leads back to its own words', () => {
    const { all, groups } = choices(table)
    const words = [all, ...groups.flatMap((group) => group.choices)].map(({ value }) => tested({ algorithm: 'a', parts: partsOf(value, table) }, table))
    expect(words).toEqual([
      'everything', 'all stress families', 'Near', 'Far', 'all relations', 'Swap', 'Unit', 'Reported failures', 'The same surface with other triangles', 'Adversarial search',
    ])
    expect(tested({ algorithm: 'a', parts: ['near', 'swap', 'far'] }, table)).toBe('3 tests')
  })

  test('it says its place or its progress', () => {
    expect(progressWords(run, table)).toBe('2 stability runs ahead in the queue.')
    expect(progressWords({ ...run, runs_ahead: 1 }, table)).toBe('1 stability run ahead in the queue.')
    expect(progressWords({ ...run, runs_ahead: 0 }, table)).toBe('Next stability run in the queue.')
    expect(progressWords({ ...run, state: 'running', done: 1, runs_ahead: 0 }, table)).toBe('1 of 2 tests done; now: Near.')
    expect(progressWords({ ...run, state: 'cancelled', done: 1, step: null }, table)).toBe('1 of 2 tests done.')
  })

  test('it says who is not in the table', () => {
    const progress = ['a', 'b', 'c'].map((algorithm) => ({ algorithm, name: algorithm, measured: 0, waiting: 0, failed: 0, of: 1 }))
    const methods = (...ids: string[]) => ids.map((algorithm) => ({ algorithm }) as Stability)
    expect(untestedWords(methods('a', 'b', 'c'), { progress, idle: true })).toBeNull()
    expect(untestedWords([], { progress, idle: true })).toBe('No algorithm has been tested yet. This service tests installed algorithms when it is idle.')
    expect(untestedWords(methods('a'), { progress, idle: false })).toBe('2 algorithms have not been tested yet. Start a test of everything to add one to the table.')
  })
})
