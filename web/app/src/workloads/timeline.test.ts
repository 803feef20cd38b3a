import { describe, expect, it } from 'vitest'
import { replay } from './sample'
import { endOf, hitShares, parts, readStretch, stretchBetween, stretchTyped, stretchWords, writeStretch } from './timeline'

const { timeline } = replay()

describe('the timeline', () => {
  it('has the time of a query in each part, and none where nothing was asked', () => {
    const [, slow] = timeline.series
    expect(slow && parts(timeline, slow)).toEqual([
      { from: 0, to: 50, n: 25, each: 20, wrong: 0 }, { from: 50, to: 75, n: 25, each: 40, wrong: 0 },
      { from: 75, to: 100, n: 0, each: null, wrong: 0 }, { from: 100, to: 125, n: 25, each: 20, wrong: 1 },
    ])
    expect([endOf(timeline), hitShares(timeline)]).toEqual([125, [1, 0, 0.2, 0.8]])
  })

  it('gives the stretch of whole parts that was brushed, in either direction', () => {
    expect(stretchBetween(timeline, 60, 80)).toEqual({ from: 50, to: 100 })
    expect(stretchBetween(timeline, 80, 60)).toEqual({ from: 50, to: 100 })
    expect(stretchBetween(timeline, 52, 52)).toEqual({ from: 50, to: 75 })
    // The ends of the recording are left open, so that nothing there is lost.
    expect(stretchBetween(timeline, -5, 10)).toEqual({ to: 50 })
    expect(stretchBetween(timeline, 110, 999)).toEqual({ from: 100 })
  })

  it('takes a typed stretch with its first and last query, or says what is wrong', () => {
    expect(stretchTyped(timeline, 10, 19)).toEqual({ stretch: { from: 10, to: 20 } })
    expect(stretchTyped(timeline, 10, '')).toEqual({ stretch: { from: 10 } })
    expect(stretchTyped(timeline, '', '')).toHaveProperty('problem')
    expect(stretchTyped(timeline, 20, 10)).toHaveProperty('problem')
    expect(stretchTyped(timeline, 0.5, 10)).toHaveProperty('problem')
    expect(stretchTyped(timeline, 125, '')).toEqual({ problem: 'The last query has the number 124.' })
  })
})

it('keeps a stretch in the link, and ignores invalid ones', () => {
  for (const stretch of [{ from: 50, to: 100 }, { from: 50 }, { to: 100 }]) expect(readStretch(writeStretch(stretch))).toEqual(stretch)
  expect(writeStretch(null)).toEqual({})
  expect([{}, { from: 'x' }, { from: '-1' }, { from: '9', to: '9' }, { from: ['1', '2'] }].map(readStretch)).toEqual([null, null, null, null, null])
  expect(readStretch({ from: '5', to: 'soon' })).toEqual({ from: 5 })
  expect(stretchWords(timeline, { from: 50, to: 100 })).toBe('queries 50 to 99')
  expect(stretchWords(timeline, {})).toBe('queries 0 to 124')
})
