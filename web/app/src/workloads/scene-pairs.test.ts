import { expect, it } from 'vitest'
import type { PosedScene, ScenePair } from '../api/types'
import { replay } from './sample'
import { drawnOf, isListed, MOST_DRAWN, pairState, pairsWords } from './scene-pairs'
import { readView } from './view'

const pair = (a: number, b: number, queries: number, disabled: string | null = null): ScenePair => ({ objects: [a, b], queries, disabled })
const scene = (n: number, pairs: ScenePair[], change: Partial<PosedScene> = {}): PosedScene => ({
  about: [], objects: Array.from({ length: n }, (_, object) => ({ object, pose: [] })), placed_by_queries: true, pairs,
  asked: pairs.filter(({ queries }) => queries > 0).length, disabled: pairs.filter(({ disabled }) => disabled).length,
  asked_though_disabled: pairs.filter(({ queries, disabled }) => queries > 0 && disabled).length, ...change,
})
const pairs = [pair(0, 1, 20), pair(1, 2, 1, 'adjacent'), pair(0, 2, 0, 'same link')]

it('says what becomes of a pair, and of all of them', () => {
  expect(pairs.map(pairState)).toEqual(['asked 20 times', 'disabled (adjacent), but asked once', 'disabled (same link)'])
  expect(pairsWords(scene(4, pairs))).toBe('2 of 6 pairs were asked. 2 are disabled, of which 1 was asked all the same; 3 are neither.')
  expect(pairsWords(scene(4, [pair(0, 1, 0, 'same link')]))).toBe('6 pairs of objects. 1 is disabled.')
  expect(pairsWords(scene(2, []))).toBe('1 pair of objects. None is disabled.')
  expect(pairsWords(scene(2, [pair(0, 1, 3)]))).toBe('1 of 1 pair was asked. The recording disables none.')
})

it('lists the pairs that were asked, or those that are disabled', () => {
  const of = (which: 'all' | 'asked' | 'disabled') => pairs.filter((one) => isListed(one, which)).map(({ objects }) => objects.join('-'))
  expect([of('all'), of('asked'), of('disabled')]).toEqual([['0-1', '1-2', '0-2'], ['0-1', '1-2'], ['1-2', '0-2']])
})

it('draws all of a small scene, and of a large one the chosen pair and what was asked most', () => {
  expect(drawnOf(scene(4, pairs), null)).toHaveLength(4)
  const large = scene(1000, [pair(700, 800, 5)])
  const drawn = drawnOf(large, [900, 950]).map(({ object }) => object)
  expect(drawn).toHaveLength(MOST_DRAWN)
  expect([700, 800, 900, 950].every((object) => drawn.includes(object))).toBe(true)
})

it('reads a pair from the link only if the scene has it', () => {
  const of = (text: string) => readView({ pair: text }, replay()).pair
  expect([of('0-2'), of('2-0'), of('0-3'), of('1'), of('0-1-2'), of('')]).toEqual([[0, 2], null, null, null, null, null])
})
