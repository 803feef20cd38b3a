import { describe, expect, it } from 'vitest'
import { DEFAULTS, readState, writeState, type ExplorerState } from './url-state'

const unusual: ExplorerState = {
  measure: 'primitive_tests',
  statistic: 'standard_deviation',
  outliers: 'global',
  side: 'b',
  colormap: 'cividis',
  log: false,
  range: 'full',
  shown: [0.25, 0.9],
  algorithms: ['box-tree', 'parry'],
  wall: true,
  points: true,
  camera: [0.6, -0.5, 4.1, 0, 0.01, 0],
  vertex: 8367,
  against: 'parry',
  againstRun: '0199aa01-0000-7000-8000-000000000000',
  selections: [{ name: 'slow', where: 'time in [500, 15000]', on: true }],
}

describe('the link', () => {
  it('leaves out what is as usual', () => {
    expect(writeState({ ...DEFAULTS })).toEqual({})
  })

  it('comes back as it was', () => {
    expect(readState(writeState(unusual))).toEqual({ state: unusual, ignored: [] })
    expect(readState(writeState({ ...DEFAULTS }))).toEqual({ state: DEFAULTS, ignored: [] })
  })

  it('is short', () => {
    expect(new URLSearchParams(writeState(unusual)).toString().length).toBeLessThan(280)
  })

  it('names what it does not know and keeps the rest', () => {
    const { state, ignored } = readState({ m: 'bv', s: 'mode', future: '1', l: 'yes' })
    expect(state).toEqual({ ...DEFAULTS, measure: 'bv_tests' })
    expect(ignored).toEqual(['s', 'future', 'l'])
  })

  it.each([
    ['cam', '1,2,3'], ['cam', '1,2,3,4,5,x'], ['rg', '0.9,0.1'], ['rg', '-1,2'], ['v', '-3'], ['v', '1.5'], ['a', 'a,b,c,d,e'], ['a', ''],
    ['vs', ''], ['vsrun', 'latest'], ['w', 'yes'], ['pt', 'yes'], ['sel', 'slow'],
  ])('refuses %s=%s', (key, value) => {
    expect(readState({ [key]: value })).toEqual({ state: DEFAULTS, ignored: [key] })
  })
})
