import { describe, expect, it } from 'vitest'
import { freshName, readSelections, tidy, writeSelections, type NamedSelection } from './list'

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

  it('names', () => {
    expect(tidy('--a:b;c ')).toBe('a b c')
    expect(freshName([{ name: 'Ball 1', where: 'wrong', on: true }], 'Ball')).toBe('Ball 2')
  })
})
