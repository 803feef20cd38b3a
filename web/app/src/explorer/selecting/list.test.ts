import { describe, expect, it } from 'vitest'
import { freshName, placed, readSelections, tidy, whereOf, writeSelections, type NamedSelection } from './list'

const list: NamedSelection[] = [
  { name: 'slow', where: 'time of box-tree:leaf_size=4 in [500, 15000]', on: true },
  { name: 'left ear', where: 'near(vertex 8367, 0.05)', on: false },
]

describe('the list of selections', () => {
  it('comes back from a link as it was', () => {
    expect(readSelections(writeSelections(list))).toEqual(list)
  })

  it('refuses what is no list', () => {
    expect(readSelections('slow')).toBeUndefined()
    expect(readSelections('a:')).toBeUndefined()
    expect(readSelections(Array.from({ length: 13 }, () => 'a:wrong').join(';'))).toBeUndefined()
  })

  it('is one predicate of those that are on', () => {
    expect(whereOf(list)).toBe('(time of box-tree:leaf_size=4 in [500, 15000])')
    expect(whereOf(list.map((one) => ({ ...one, on: true })))).toMatch(/^\(time .*\) & \(near\(vertex 8367, 0\.05\)\)$/)
    expect(whereOf([])).toBe('')
  })

  it('has one brushed place at a time', () => {
    const one = placed(list, 'near(vertex 1, 0.05)')
    expect(one.slice(0, 2)).toEqual(list)
    expect(placed(one, 'near(vertex 2, 0.1)').map(({ where }) => where).slice(2)).toEqual(['near(vertex 2, 0.1)'])
    const full = Array.from({ length: 12 }, () => ({ name: 'a', where: 'wrong', on: true }))
    expect(placed(full, 'near(vertex 1, 0.05)')).toEqual(full)
  })

  it('names', () => {
    expect(tidy('--a:b;c ')).toBe('a b c')
    expect(freshName([{ name: 'Ball 1', where: 'wrong', on: true }], 'Ball')).toBe('Ball 2')
  })
})
