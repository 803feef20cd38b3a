import { describe, expect, test } from 'vitest'
import type { Stability, StabilityTable, Tally } from '../api/types'
import { cell, columns, passed, short, tableOf, tallyWords, views } from './table'

const none: Tally = { agrees: 0, grazing: 0, misses: 0, false_alarms: 0, distances: 0, unsteady: 0, broken: 0, slow: 0, unsupported: 0, refused: 0 }
const family = (id: string, beyond = false) => ({ id, name: id, sentence: '', source: '', parameter: 'x', continuous: false, harder: 'large' as const, beyond })
const table: StabilityTable = {
  families: [family('near'), family('far'), family('nan', true)],
  relations: [{ id: 'swap', name: 'Swap', sentence: '' }],
  failures: [{ id: 'pqp-4', source: 'PQP, issue 4', url: 'https://example.org', seen: 'wrong', numbers_reported: true }],
  methods: [],
}
const of = (id: string, state: Stability['families'][0]['state'], tally: Partial<Tally>) =>
  ({ family: id, state, tally: { ...none, ...tally }, steps: [], thresholds: [], first: null })
const method: Stability = {
  algorithm: 'm', name: 'M', version: '1', plugin_sha256: '', single_precision: false, seeds: 1, created_us: 0, complete: true,
  families: [of('near', 'wrong', { agrees: 5, misses: 2, false_alarms: 3 }), of('far', 'agrees', { agrees: 7 }), of('nan', 'broken', { broken: 1 })],
  relations: [{ relation: 'swap', tried: 9, decisions: 1, distances: 2, grazing: 0, steps: [], first: null }],
  failures: [{ id: 'pqp-4', state: 'agrees', expected: '', got: 'no collision' }],
  tessellations: [], search: null, unit_safe: null, offset_safe: null,
}

describe('the stability table', () => {
  test('misses stand apart from all other wrong answers', () => {
    expect(cell(method, 'families', 'near')).toEqual({ state: 'wrong', count: '2+3', words: '5 right, 2 missed collisions, 3 false alarms' })
    expect(cell(method, 'relations', 'swap')).toMatchObject({ state: 'wrong', count: '1/2' })
    expect(cell(method, 'reported', 'pqp-4')).toMatchObject({ state: 'agrees', words: 'no collision' })
    expect(cell(method, 'families', 'unknown')).toBeNull()
  })

  test('what is beyond the promise does not count', () => {
    expect(passed(method, table, 'families')).toEqual({ good: 1, of: 2 })
    expect(passed(method, table, 'relations')).toEqual({ good: 0, of: 1 })
  })

  test('one is not many', () => {
    expect(tallyWords({ ...none, misses: 1, slow: 2 })).toBe('0 right, 1 missed collision, 2 slow answers')
  })

  test('every view has its columns', () => {
    expect(columns(table, 'reported')[0]).toMatchObject({ id: 'pqp-4', name: 'PQP, issue 4' })
    expect(columns(table, 'families').map(({ id }) => id)).toEqual(['near', 'far', 'nan'])
  })

  test('a result alone shows what was tried', () => {
    const whole = { ...table, families: [...table.families, family('untried')] }
    expect(columns(tableOf(method, whole), 'families').map(({ id }) => id)).toEqual(['near', 'far', 'nan'])
    expect(views(tableOf({ ...method, relations: [], failures: [] }, whole))).toEqual(['families'])
  })

  test('numbers are short', () => {
    expect([1e-7, 3.1623e-5, 0.25, 1048576, 65536, 0, -40, 1e18].map(short)).toEqual(['1e-7', '3.16e-5', '0.25', '1,049,000', '65,540', '0', '-40', '1e18'])
  })
})
