import { describe, expect, it } from 'vitest'
import cases from '../../../../../host/core/src/selection/cases.json'
import { apply, type Columns } from './apply'
import { algorithms, parse, SelectionError, write } from './language'

const all = cases.columns as Record<string, (number | null)[]>
const get = (name: string) => {
  const column = all[name]
  if (!column) throw new Error(`no ${name}`)
  return column.map((x) => x ?? Number.NaN)
}
const columns: Columns = {
  column: (column, of) => get(of === null ? column : `${column} of ${of}`),
  fromVertex: (body, vertex) => get(`near ${body} ${vertex}`),
}

function refusal(text: string): SelectionError {
  try {
    parse(text)
  } catch (error) {
    if (error instanceof SelectionError) return error
  }
  throw new Error(`${text} is no selection, and was read all the same`)
}

describe('the language that engine, command line and pages share', () => {
  it.each(cases.good as [string, string, number[]][])('%s', (text, canonical, members) => {
    const selection = parse(text)
    expect(write(selection)).toBe(canonical)
    expect(parse(write(selection))).toEqual(selection)
    expect([...apply(selection, columns)].flatMap((is, i) => (is ? [i] : []))).toEqual(members)
  })

  it.each(cases.bad as [string, number, string][])('refuses %s', (text, at, what) => {
    const error = refusal(text)
    expect(error.at).toBe(at)
    expect(error.what).toContain(what)
  })

  it('has bounds', () => {
    expect(() => parse(`${'!'.repeat(50)}wrong`)).toThrow('deeper')
    expect(() => parse(`${'wrong & '.repeat(500)}wrong`)).toThrow('longer')
  })

  it('tells whose columns it needs', () => {
    expect(algorithms(parse('time in [0, 1] & !(wrong of b | missed of b) & distance in [0, 1] & near(vertex 1, 1)'), 'a')).toEqual(['a', 'b'])
  })
})
