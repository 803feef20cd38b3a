import { describe, expect, it } from 'vitest'
import type { AlgorithmInfo } from '../api/types'
import { chosenNames, commandLine, fromSpec, toSpec, usualForm } from './spec'

const known = [{ id: 'box-tree', usual: true }, { id: 'fcl', usual: true }, { id: 'brute', usual: false }] as AlgorithmInfo[]

describe('the spec of a replay', () => {
  it('names no algorithms when the usual ones are meant', () => {
    expect(toSpec(usualForm())).toEqual({ spec: { algorithms: [], tracks: ['shuffled', 'recorded', 'scene'], passes: 3, budget_seconds: 10, seed: null, reduce: null } })
    expect(chosenNames(usualForm(), known)).toEqual(['box-tree', 'fcl'])
    expect(toSpec({ ...usualForm(), algorithms: ['brute'], orders: 'recorded' })).toMatchObject({ spec: { algorithms: ['brute'], tracks: ['recorded'] } })
  })

  it('asks for the simplest scene when that is wanted, and takes it over', () => {
    const form = { ...usualForm(), reduce: { wanted: true, tolerance: 0.01, near: 0.001, outsideOnly: true, frontier: true } }
    const asked = toSpec(form)
    expect(asked).toMatchObject({ spec: { reduce: { tolerance: 0.01, near: 0.001, outside_only: true, frontier: true } } })
    expect('spec' in asked && fromSpec(asked.spec, known)).toEqual(form)
  })

  it('is refused with the reason before it is sent', () => {
    const refused = [{ algorithms: [] }, { passes: '' as const }, { passes: 1.5 }, { passes: 65 }, { budget: '' as const }, { budget: 0 }, { budget: 86_401 }, { reduce: { wanted: true, tolerance: 0, near: 0, outsideOnly: false, frontier: false } }, { reduce: { wanted: true, tolerance: 0.1, near: 0.05, outsideOnly: false, frontier: false } }]
    for (const change of refused) expect(toSpec({ ...usualForm(), ...change })).toHaveProperty('problem')
  })

  it('is taken over from an earlier replay, without algorithms that are no longer installed', () => {
    const before = { algorithms: ['fcl', 'box-tree:leaf_size=4', 'gone'], tracks: ['recorded' as const], passes: 5, budget_seconds: 9 }
    const form = fromSpec(before, known)
    expect(form).toEqual({ algorithms: ['fcl', 'box-tree:leaf_size=4'], orders: 'recorded', passes: 5, budget: 9, reduce: usualForm().reduce })
    expect(fromSpec({}, known)).toEqual(usualForm())
    expect(fromSpec({ algorithms: ['all'] }, known).algorithms).toEqual(['box-tree', 'fcl', 'brute'])
    expect(fromSpec({ algorithms: ['gone'] }, known).algorithms).toBeNull()
  })
})

it('is repeated on the command line with the seed that was used', () => {
  const spec = { algorithms: ['fcl', 'box-tree:leaf_size=4'], tracks: ['recorded' as const], passes: 5, budget_seconds: 9 }
  expect(commandLine('my arm.ocbrec', spec, { seed: 7 }).split(' \\\n  ')).toEqual([
    "ocb bench --workload 'my arm.ocbrec'", '--algorithm fcl,box-tree:leaf_size=4', '--order recorded', '--passes 5', '--budget 9', '--run-seed 7',
  ])
  expect(commandLine('a.ocbrec', { algorithms: [], tracks: ['shuffled', 'recorded', 'scene'] }, null)).toBe('ocb bench --workload a.ocbrec')
  expect(commandLine('a.ocbrec', { tracks: ['shuffled', 'recorded'] }, null)).toContain('--order shuffled,recorded')
})
