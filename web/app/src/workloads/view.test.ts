import { expect, it } from 'vitest'
import { algorithm, replay } from './sample'
import { changed, readView } from './view'

const result = replay()

it('shows the first order and the fastest algorithm unless the link says otherwise', () => {
  const usual = readView({}, result)
  expect(usual).toMatchObject({ order: 'shuffled', algorithm: 'fast', shown: 'time', lines: ['fast', 'slow'], stretch: null })
  expect(readView({ order: 'recorded', algorithm: 'slow', show: 'wrong', lines: 'slow', from: '5' }, result)).toMatchObject({
    order: 'recorded', algorithm: 'slow', shown: 'wrong', lines: ['slow'], stretch: { from: 5 },
  })
})

it('ignores what the result does not have', () => {
  const { tracks: [shuffled] } = result
  const one = replay({ tracks: shuffled ? [shuffled] : [] })
  expect(readView({ order: 'recorded', algorithm: 'gone', show: 'colour', lines: 'gone,slow' }, one)).toMatchObject({
    order: 'shuffled', algorithm: 'fast', shown: 'time', lines: ['slow'],
  })
  expect(readView({}, replay({ tracks: [] }))).toMatchObject({ algorithms: [], algorithm: '', lines: [] })
})

it('draws the four fastest at first, none that was wrong before them', () => {
  const all = [algorithm('wrong', 1, { wrong: 1 }), ...['e', 'd', 'c', 'b', 'a'].map((id, i) => algorithm(id, 500 - i))]
  expect(readView({}, replay({ tracks: [{ track: 'shuffled', algorithms: all }] })).lines).toEqual(['a', 'b', 'c', 'd'])
})

it('changes some keys of the link and keeps the others', () => {
  expect(changed({ from: '1', order: 'recorded', odd: ['x'] }, { from: undefined, to: '9' })).toEqual({ order: 'recorded', to: '9' })
})
