import { bool, columnFromArray, float64, tableFromColumns, tableToIPC, uint32 } from '@uwdata/flechette'
import { afterEach, beforeEach, expect, it, vi } from 'vitest'
import { Selecting, type Question } from './engine'

type Values = [values: (number | boolean)[], axis?: string]
/** A table as the service sends it. */
function sent(columns: Record<string, Values>): Response {
  const type = ([first]: (number | boolean)[], name: string) =>
    typeof first === 'boolean' ? bool() : name.startsWith('triangle') ? uint32() : float64()
  const table = tableFromColumns(
    Object.entries(columns).map(([name, [values]]) => [name, columnFromArray(values, type(values, name))] as [string, ReturnType<typeof columnFromArray>]),
  )
  for (const field of table.schema.fields) {
    const axis = columns[field.name]?.[1]
    if (axis) field.metadata = new Map([['axis', axis], ['unit', 'tests']])
  }
  return new Response(tableToIPC(table, { format: 'stream' }) as Uint8Array<ArrayBuffer>)
}

const asked: string[] = []
beforeEach(() => {
  asked.length = 0
  vi.stubGlobal('fetch', async (url: string) => {
    asked.push(url.replace('/api/v1/runs/r/', ''))
    if (url.includes('selection.arrow') && url.includes('tame')) return Response.json({ detail: 'at character 1' }, { status: 422 })
    if (url.includes('selection.arrow')) return sent({ chosen: [[true, false, url.includes('wrong')]] })
    if (url.includes('witnesses')) return sent({ distance: [[1, 2, 3], 'true distance'], triangle_a: [[0, 0, 1]] })
    return sent({ time: [[5, 6, 7], 'time per query'], bv: [[1, 2, 4], 'BV tests'] })
  })
})
afterEach(() => vi.unstubAllGlobals())

const surface = { positions: new Float32Array(18), corners: Uint32Array.from([0, 1, 2, 3, 4, 5]), longest: 1 }
const question = (...where: string[]): Question => ({ where, lookedAt: 'x', side: 'a', points: false, y: null, cells: [4, 4], algorithms: ['x'] })

it('counts what the service says that all selections hold, and asks once for each', async () => {
  const selecting = new Selecting('r', { a: surface, b: surface })
  const both = await selecting.answer(question('wrong', 'bv in [1, 2]'))
  expect(both).toMatchObject({ of: 3, n: 1, each: [2, 1], rows: [{ algorithm: 'x', n: 1, median: 5 }] })
  expect([...(both.lit ?? [])]).toEqual([1, 1, 1, 0, 0, 0])
  expect((await selecting.answer(question('wrong'))).n).toBe(2)
  expect(asked.filter((url) => url.startsWith('selection'))).toEqual(['selection.arrow?algorithm=x&where=wrong', 'selection.arrow?algorithm=x&where=bv+in+%5B1%2C+2%5D'])
})

it('knows from the service which columns a chart can show', async () => {
  const { columns, chart } = await new Selecting('r', { a: surface, b: surface }).answer(question())
  expect(columns).toEqual([
    { name: 'bv', axis: 'BV tests', unit: 'tests', shared: false }, { name: 'distance', axis: 'true distance', unit: 'tests', shared: true },
  ])
  expect(chart?.column.name).toBe('bv')
})

it('passes on why a selection cannot be read', async () => {
  await expect(new Selecting('r', { a: surface, b: surface }).answer(question('tame'))).rejects.toThrow('at character 1')
})
