import { expect, it } from 'vitest'
import type { ObjectHeatmap, ObjectMeasure } from '../api/types'
import { objectHeatmapFile } from '../api/workloads'
import { heatmapWords, legendOf } from './object-heatmap'
import { replay } from './sample'
import { heatmapCommand } from './spec'
import { readView } from './view'

const map = (measure: ObjectMeasure, unit: string, values: (number | null)[], counts: number[]): ObjectHeatmap => {
  const present = values.filter((value) => value !== null)
  return {
    object: 1, request: { algorithm: 'fast', order: 'shuffled', measure }, unit, values, counts, n: 20,
    range: present.length > 0 ? [Math.min(...present), Math.max(...present)] : null,
  }
}

it('says how far the queries reach, and where there is most', () => {
  expect(heatmapWords(map('time', 'ns', [100, null, 300], [12, 0, 8]), 'table')).toMatch(/^20 queries about table reach 2 of its 3 vertices; the longest mean, 300.ns, is at vertex 2 with n = 8\.$/)
  expect(heatmapWords(map('wrong', 'share', [0, 0, null], [12, 8, 0]), 'table')).toBe('20 queries about table reach 2 of its 3 vertices; no answer is wrong.')
  expect(heatmapWords(map('queries', 'queries', [12, null], [12, 0]), 'table')).toContain('the most, 12')
  expect(heatmapWords(map('time', 'ns', [null], [0]), 'table')).toContain('No query about table')
})

it('has no legend where no vertex has a value, and counts those without one', () => {
  expect(legendOf(map('time', 'ns', [null, null], [0, 0]), false)).toBeNull()
  const time = legendOf(map('time', 'ns', [100, null, 300], [12, 0, 2]), true)
  expect(time).toMatchObject({ unit: 'ns', n: 20, range: [100, 300], scale: { log: true, lo: 100, hi: 300 }, coverage: { noData: 1, few: 1 } })
  // A share begins at 0 and is never logarithmic, and no vertex of it is paler.
  const wrong = legendOf(map('wrong', 'share', [0.5, 0.25], [1, 1]), true)
  expect(wrong).toMatchObject({ scale: { log: false, lo: 0, hi: 0.5 }, coverage: { few: 0 } })
})

it('reads object, measure and scale from the link, and takes the dearest object otherwise', () => {
  const result = replay()
  expect(readView({}, result)).toMatchObject({ object: 0, measure: 'time', log: false })
  expect(readView({ object: '2', measure: 'wrong', log: '1' }, result)).toMatchObject({ object: 2, measure: 'wrong', log: true })
  expect(readView({ object: '3', measure: 'colour' }, result)).toMatchObject({ object: 0, measure: 'time' })
})

it('names the same queries in the file and on the command line', () => {
  const request = { algorithm: 'box-tree:leaf_size=4', order: 'recorded', measure: 'wrong', from: 5, to: 9 } as const
  expect(objectHeatmapFile('7', 2, 'ply', request, true)).toBe(
    '/api/v1/workloads/7/objects/2/heatmap.ply?algorithm=box-tree%3Aleaf_size%3D4&order=recorded&measure=wrong&from=5&to=9&scale=log')
  expect(heatmapCommand('my arm.ocbrec', 'workload-7.parquet', 'link 2', request).replace(/\s*\\\n\s*/g, ' ')).toBe(
    "ocb scene heatmap 'my arm.ocbrec' workload-7.parquet --object 'link 2' --algorithm box-tree:leaf_size=4 --order recorded --measure wrong --from 5 --to 9 --output heatmap.ply")
})
