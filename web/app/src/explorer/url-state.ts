import type { Measure, Outliers, Side, Statistic } from '../api/types'
import { COLORMAPS, type Colormap } from './colormap'
import type { RangeRule } from './scale'
import { readSelections, writeSelections, type NamedSelection } from './selecting/list'

/** Everything that a link to the explorer holds. */
export interface ExplorerState {
  measure: Measure
  statistic: Statistic
  outliers: Outliers
  side: Side
  colormap: Colormap
  log: boolean
  range: RangeRule
  /** Positions on the scale between which the surface is coloured. */
  shown: [number, number]
  /** Algorithms on the screen, at most four; empty: the first four of the run. */
  algorithms: string[]
  /** Every measured algorithm at once, instead of those. */
  wall: boolean
  /** The closest points over the surface, instead of a heatmap. */
  points: boolean
  /** Camera relative to the object, six numbers; empty: the starting view. */
  camera: number[]
  /** The vertex that is read. */
  vertex: number | null
  /** The algorithm whose values are subtracted; empty: none, or the same one of the other run. */
  against: string
  /** The run whose values are subtracted; empty: this one. */
  againstRun: string
  /** Named predicates over the configurations; those that are on hold together. */
  selections: NamedSelection[]
}

export const MAX_PANES = 4

export const DEFAULTS: Readonly<ExplorerState> = {
  measure: 'time',
  statistic: 'median',
  outliers: 'per_vertex',
  side: 'a',
  colormap: 'turbo',
  log: true,
  range: 'p2-98',
  shown: [0, 1],
  algorithms: [],
  wall: false,
  points: false,
  camera: [],
  vertex: null,
  against: '',
  againstRun: '',
  selections: [],
}

/** Short words in the link for the names of the API. */
const MEASURES: Record<Measure, string> = {
  time: 't', bv_tests: 'bv', primitive_tests: 'prim', triangle_tests: 'tri', density: 'n', wrong: 'wrong',
  missed: 'fn', false_alarms: 'fp', distance_error: 'err', flips: 'flip', disagreement: 'dis',
}
const STATISTICS: Record<Statistic, string> = {
  mean: 'mean', median: 'median', min: 'min', max: 'max', standard_deviation: 'sd', mad: 'mad',
}
const OUTLIERS: Record<Outliers, string> = { keep: 'keep', per_vertex: 'vertex', global: 'global' }
const SIDES: Record<Side, string> = { a: 'a', b: 'b' }
/** Are differences shown? Two algorithms of one run have the same density. */
export const differs = ({ against, againstRun, measure }: ExplorerState): boolean =>
  againstRun !== '' || (against !== '' && measure !== 'density')

const RANGES: Record<RangeRule, string> = { 'p2-98': 'p', full: 'full' }

export type Query = Record<string, string>

/** Writes a state as the link's query; defaults are left out. */
export function writeState(state: ExplorerState): Query {
  const query: Query = {}
  const put = (key: string, value: string, fallback: string) => {
    if (value !== fallback) query[key] = value
  }
  put('m', MEASURES[state.measure], MEASURES[DEFAULTS.measure])
  put('s', STATISTICS[state.statistic], STATISTICS[DEFAULTS.statistic])
  put('o', OUTLIERS[state.outliers], OUTLIERS[DEFAULTS.outliers])
  put('d', SIDES[state.side], SIDES[DEFAULTS.side])
  put('c', state.colormap, DEFAULTS.colormap)
  put('l', state.log ? '1' : '0', DEFAULTS.log ? '1' : '0')
  put('k', RANGES[state.range], RANGES[DEFAULTS.range])
  put('rg', state.shown.join(','), DEFAULTS.shown.join(','))
  put('a', state.algorithms.join(','), '')
  put('w', state.wall ? '1' : '0', '0')
  put('pt', state.points ? '1' : '0', '0')
  put('cam', state.camera.join(','), '')
  put('v', state.vertex === null ? '' : String(state.vertex), '')
  put('vs', state.against, '')
  put('vsrun', state.againstRun, '')
  put('sel', writeSelections(state.selections), '')
  return query
}

/** Reads a link. What it does not understand keeps its default and is named in `ignored`. */
export function readState(query: Record<string, unknown>): { state: ExplorerState; ignored: string[] } {
  const state: ExplorerState = { ...DEFAULTS, shown: [...DEFAULTS.shown], algorithms: [], camera: [], selections: [] }
  const ignored: string[] = []
  for (const [key, raw] of Object.entries(query)) {
    if (typeof raw !== 'string' || !readKey(state, key, raw)) ignored.push(key)
  }
  return { state, ignored }
}

function readKey(state: ExplorerState, key: string, raw: string): boolean {
  switch (key) {
    case 'm':
      return assign(state, 'measure', nameOf(MEASURES, raw))
    case 's':
      return assign(state, 'statistic', nameOf(STATISTICS, raw))
    case 'o':
      return assign(state, 'outliers', nameOf(OUTLIERS, raw))
    case 'd':
      return assign(state, 'side', nameOf(SIDES, raw))
    case 'k':
      return assign(state, 'range', nameOf(RANGES, raw))
    case 'c':
      return assign(state, 'colormap', COLORMAPS.find((name) => name === raw))
    case 'l':
      return assign(state, 'log', flag(raw))
    case 'w':
      return assign(state, 'wall', flag(raw))
    case 'pt':
      return assign(state, 'points', flag(raw))
    case 'rg':
      return assign(state, 'shown', shownRange(numbers(raw)))
    case 'cam': {
      const view = numbers(raw)
      return assign(state, 'camera', view?.length === 6 ? view : undefined)
    }
    case 'a':
      return assign(state, 'algorithms', algorithmList(raw))
    case 'v':
      return assign(state, 'vertex', /^\d{1,9}$/.test(raw) ? Number(raw) : undefined)
    case 'vs':
      return assign(state, 'against', raw.length > 0 && raw.length <= 120 ? raw : undefined)
    case 'vsrun':
      return assign(state, 'againstRun', /^[0-9a-f-]{36}$/.test(raw) ? raw : undefined)
    case 'sel':
      return assign(state, 'selections', readSelections(raw))
    default:
      return false
  }
}

function assign<K extends keyof ExplorerState>(state: ExplorerState, key: K, value: ExplorerState[K] | undefined): boolean {
  if (value === undefined) return false
  state[key] = value
  return true
}

function nameOf<T extends string>(names: Record<T, string>, short: string): T | undefined {
  return (Object.keys(names) as T[]).find((name) => names[name] === short)
}

const flag = (raw: string): boolean | undefined => (raw === '1' ? true : raw === '0' ? false : undefined)

function numbers(raw: string): number[] | undefined {
  const all = raw.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)))
  return all.every(Number.isFinite) ? all : undefined
}

function shownRange(ends: number[] | undefined): [number, number] | undefined {
  const [lo, hi] = ends ?? []
  return ends?.length === 2 && lo !== undefined && hi !== undefined && lo >= 0 && hi <= 1 && lo < hi ? [lo, hi] : undefined
}

function algorithmList(raw: string): string[] | undefined {
  const ids = [...new Set(raw.split(','))]
  return ids.length <= MAX_PANES && ids.every((id) => id.length > 0 && id.length <= 120) ? ids : undefined
}
