import { describe, expect, it } from 'vitest'
import { comparable, gain, isFair, listed, standing } from './fastest'
import { algorithm, replay } from './sample'
import { dearestWords, outcomeWords, standingWords, whyApart } from './words'

const ended = [{ objects: [0, 1], outcome: { name: 'TimedOut' as const, message: 'It took too long.', ours: false } }]

describe('the fastest', () => {
  it('is never one that was wrong, silent, cut off, or asked less', () => {
    const unfair = [
      algorithm('wrong', 1, { wrong: 1 }), algorithm('silent', 1, { silent: 1 }), algorithm('cut', 1, { ended }), algorithm('budget', 1, { n: 99 }),
      algorithm('nothing', 1, { n: 0, of: 0 }), algorithm('untimed', 1, { total: null }),
    ]
    expect(unfair.filter(isFair).map(({ algorithm: id }) => id)).toEqual(['untimed'])
    expect(standing(unfair)).toBeNull()
    expect(standing([...unfair, algorithm('slow', 9), algorithm('fair', 5)])?.fastest.algorithm).toBe('fair')
  })

  it('is compared only with those that answer as many queries', () => {
    const all = [algorithm('half', 1, { n: 50, of: 50 }), algorithm('b', 40), algorithm('a', 20), algorithm('wrong', 1, { wrong: 2 })]
    expect(comparable(all).map(({ algorithm: id }) => id)).toEqual(['a', 'b'])
    expect(listed(all).map(({ one, ratio }) => [one.algorithm, ratio])).toEqual([['a', 1], ['b', 2], ['half', null], ['wrong', null]])
  })

  it('is named only where the ranges lie apart', () => {
    expect(standingWords(standing([algorithm('a', 1000), algorithm('b', 2500)]))).toBe(
      'A answers these queries fastest, 2.5 times as fast as B, with no wrong answer to 100 queries.',
    )
    expect(standingWords(standing([algorithm('a', 1000), algorithm('b', 1100)]))).toContain('A and B are the fastest and cannot be told apart')
    expect(standingWords(standing([algorithm('a', 1000)]))).toContain('the only algorithm')
    expect(standingWords(null)).toContain('none is called the fastest')
  })

  it('is not named where the range of any other, not only of the next, overlaps its own', () => {
    const wide = algorithm('wide', 1900, { total: { ns: 1900, lowest_ns: 1050, highest_ns: 2800 } })
    const found = standing([algorithm('a', 1000), algorithm('b', 1800), wide])
    expect([found?.next?.one.algorithm, found?.tied.map(({ algorithm: id }) => id)]).toEqual(['b', ['wide']])
    expect(standingWords(found)).toContain('A and WIDE are the fastest and cannot be told apart')
    expect(standingWords(standing([algorithm('a', 1000), algorithm('b', 1050), wide]))).toContain('A, B and WIDE are the fastest')
  })

  it('comes with the pair that takes most of its time', () => {
    const result = replay()
    const found = standing(result.tracks[0]?.algorithms ?? [])
    expect(found && dearestWords(result, found)).toBe('FAST spends 75\u202f% of its time on one pair, arm against table, with 60\u202f% of the queries.')
    const idle = { fastest: algorithm('a', 0), next: null, tied: [] }
    expect(dearestWords(result, idle)).toBeNull()
  })
})

describe('the gain by the order of the recording', () => {
  it('is told apart only where the ranges are', () => {
    expect(gain(replay(), 'fast')).toEqual({ ratio: 2, apart: true })
    const slow = gain(replay(), 'slow')
    expect([slow?.ratio.toFixed(2), slow?.apart]).toEqual(['1.03', false])
  })

  it('needs both orders and the same queries', () => {
    const [shuffled, recorded] = replay().tracks
    expect(gain(replay({ tracks: shuffled ? [shuffled] : [] }), 'fast')).toBeNull()
    const less = { track: 'recorded' as const, algorithms: [algorithm('fast', 500, { n: 80 })] }
    expect(gain(replay({ tracks: shuffled && recorded ? [shuffled, less] : [] }), 'fast')).toBeNull()
    expect(gain(replay(), 'unknown')).toBeNull()
  })
})

it('says of each algorithm without a comparison why', () => {
  expect(whyApart(algorithm('a', 1), 100)).toBeNull()
  expect(whyApart(algorithm('a', 1, { n: 40, of: 40 }), 100)).toContain('40 of the 100 queries only')
  expect(whyApart(algorithm('a', 1, { wrong: 1, n: 3 }), 100)).toContain('wrong answers')
  expect(whyApart(algorithm('a', 1, { silent: 4 }), 100)).toContain('no answer to 4')
  expect(whyApart(algorithm('a', 1, { n: 40 }), 100)).toContain('within its budget')
  expect([{}, { n: 40 }, { ended }].map((change) => outcomeWords(algorithm('a', 1, change)))).toEqual(['Completed', 'Budget used up', 'TimedOut on 1 pair'])
})
