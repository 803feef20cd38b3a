import { describe, expect, it } from 'vitest'
import { coverage, datum, FEW } from './datum'

const map = { values: [2.5, null, null, 7], counts: [FEW / 2, 0, 0, 40], dropped: [0, 0, 3, 1] }

describe('datum', () => {
  it('tells the shader value, presence, loss and trust', () => {
    expect([...datum(map, true)]).toEqual([2.5, 1, 0, 0.5, 0, 0, 0, 0, 0, 0, 1, 0, 7, 1, 0, 1])
  })

  it('does not fade where the count is the value', () => {
    expect(datum(map, false)[3]).toBe(1)
  })
})

it('counts the states of the vertices', () => {
  expect(coverage([map])).toEqual({ maps: 1, vertices: 4, coloured: 2, noData: 1, allDropped: 1, few: 1 })
})
