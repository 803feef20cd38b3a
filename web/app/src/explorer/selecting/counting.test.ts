import { describe, expect, it } from 'vitest'
import { ascending, axis, cell, counted, litVertices, places, sortedChosen } from './counting'

describe('a chart of configurations', () => {
  it('has a logarithmic axis where all values are positive and differ', () => {
    const x = axis([1, 100, Number.NaN], 10)
    expect(x).toMatchObject({ log: true, cells: 10 })
    expect([cell(x, 1), cell(x, 100), cell(x, 10), cell(x, 1000), cell(x, Number.NaN), cell(x, 0)]).toEqual([0, 9, 5, -1, -1, -1])
  })

  it('has a linear axis where there are zeros, or one value only', () => {
    expect(axis([0, 50], 4).log).toBe(false)
    expect(axis([7, 7], 4)).toMatchObject({ log: false, lo: 6.86, hi: 7.14 })
    expect(axis([], 4)).toEqual({ log: false, lo: 0, hi: 1, cells: 4 })
  })

  it('counts what lies in each cell, and what of it is selected', () => {
    const unit = { lo: 0, hi: 2, log: false, cells: 2 }
    const chosen = Uint8Array.from([1, 0, 1, 1])
    const at = places([0.5, 0.5, 1.5, Number.NaN], [0.5, 0.5, 1.5, 0], unit, unit)
    expect([...counted(at, 4, null)]).toEqual([2, 0, 0, 1])
    expect([...counted(at, 4, chosen)]).toEqual([1, 0, 0, 1])
  })
})

describe('a region of the object', () => {
  it('is the corners of the triangles that hold the witness points', () => {
    const corners = [0, 1, 2, 1, 3, 2, 3, 4, 5]
    expect([...litVertices(Uint8Array.from([0, 1, 1]), [0, 1, 1], corners, 6)]).toEqual([0, 1, 1, 1, 0, 0])
  })

  it('has times', () => {
    const values = [3, Number.NaN, 1, 2]
    const order = ascending(values)
    expect([...order]).toEqual([2, 3, 0])
    expect([...sortedChosen(values, order, Uint8Array.from([1, 1, 1, 0]))]).toEqual([1, 3])
  })
})
