import { describe, expect, it } from 'vitest'
import type { ReducedScene } from '../api/types'
import { certifiedWords, laterWords, reduceCommand, savedWords } from './reduction'

const scene = (change: Partial<ReducedScene> = {}): ReducedScene => ({
  tolerance: 0.001, near: 0, outside_only: false, queries: 1200, left_out: 0, hits: 7, grazing: 2,
  objects: [{ name: 'arm', body: 'capsule', before: 300, after: 2, queries: 900 }, { name: 'hand', body: 'object', before: 700, after: 700, queries: 300 }],
  speed: [
    { algorithm: 'box-tree', before_ns: 800, after_ns: 200, faster: [4.2, 3.9], wrong: 0 },
    { algorithm: 'fcl', before_ns: null, after_ns: null, faster: null, wrong: 0 },
  ],
  ...change,
})

describe('a reduced scene in words', () => {
  it('says what it saved, by the smaller of both ratios', () => {
    expect(savedWords(scene())).toBe('1,000 elements became 702. box-tree gains most: its queries are at least 3.9 times as fast.')
    expect(savedWords(scene({ speed: [] }))).toBe('1,000 elements became 702.')
  })

  it('says what is certified, and for which queries', () => {
    expect(certifiedWords(scene())).toContain('each of 1,200 recorded queries: the answer is right for a distance within 0.001')
    expect(certifiedWords(scene())).toContain('Of 7 recorded collisions, 2 became gaps')
    const outside = certifiedWords(scene({ outside_only: true, near: 0.0001 }))
    expect(outside).toContain('moved relative to the other by less than 0.0001')
    expect(outside).toContain('no collision is missed, recorded or not')
  })

  it('says when a choice does not hold for later queries', () => {
    const later = (seen: number) => ({ queries: 240, changed: { seen, of: 240, lo: 0.001, hi: 0.02 }, missed: 1, examples: [] })
    expect(laterWords(scene())).toContain('too short')
    expect(laterWords(scene({ held_out: later(0) }))).not.toContain('not covered')
    expect(laterWords(scene({ held_out: later(3) }))).toContain('change 3 of these by more than the tolerance: 1.25 % [0.1 %, 2 %]; 1 of them are missed')
    expect(laterWords(scene({ held_out: later(3) }))).toContain('not covered; a neighbourhood')
    expect(laterWords(scene({ held_out: later(3), near: 0.1 }))).toContain('not covered outside of the neighbourhoods')
  })
})

it('is repeated on the command line', () => {
  const terms = { tolerance: 0.01, near: 0.001, outside_only: true, frontier: true }
  expect(reduceCommand('my arm.ocbrec', terms, ['fcl', 'box-tree']).split(' \\\n  ')).toEqual([
    "ocb scene reduce 'my arm.ocbrec'", '--tolerance 0.01', '--near 0.001', '--outside-only', '--frontier', '--algorithm fcl,box-tree', '--out reduced',
  ])
  expect(reduceCommand('a.ocbrec', { tolerance: 1 }, []).split(' \\\n  ')).toEqual(['ocb scene reduce a.ocbrec', '--tolerance 1', '--out reduced'])
})
