import type { CellState, FamilyResult, RelationResult, Stability, StabilityTable, Tally } from '../api/types'

export const VIEWS = ['families', 'relations', 'reported'] as const
export type View = (typeof VIEWS)[number]

/** A sign, a word and a tone per state: told apart without colour. */
export const STATES: Readonly<Record<CellState, { sign: string; words: string; tone: 'good' | 'warn' | 'bad' | 'quiet' }>> = {
  agrees: { sign: '●', words: 'agrees with the truth', tone: 'good' },
  slow: { sign: '◔', words: 'more than 10 times its own median time', tone: 'warn' },
  wrong: { sign: '✕', words: 'wrong answers', tone: 'bad' },
  broken: { sign: '■', words: 'crash, hang or invalid answer', tone: 'bad' },
  unsupported: { sign: '–', words: 'not answered', tone: 'quiet' },
  refused: { sign: '⊘', words: 'refused by the host', tone: 'quiet' },
}

export interface Column {
  id: string
  name: string
  sentence: string
  /** Asks for more than the interface promises. */
  beyond: boolean
}

export interface Cell {
  state: CellState
  /** How many, of what the state is about; empty where a number says nothing. */
  count: string
  /** All of it in words, for readers of the screen. */
  words: string
}

const plural = (n: number, one: string, many = `${one}s`) => `${n} ${n === 1 ? one : many}`

/** Misses and false alarms are never added up. */
export function tallyWords(tally: Tally): string {
  const parts: [number, string][] = [
    [tally.misses, plural(tally.misses, 'missed collision')],
    [tally.false_alarms, plural(tally.false_alarms, 'false alarm')],
    [tally.distances, plural(tally.distances, 'wrong distance')],
    [tally.unsteady, plural(tally.unsteady, 'answer that changed', 'answers that changed')],
    [tally.broken, plural(tally.broken, 'crash, hang or invalid answer', 'crashes, hangs or invalid answers')],
    [tally.slow, plural(tally.slow, 'slow answer')],
    [tally.unsupported, `${tally.unsupported} not answered`],
    [tally.refused, `${tally.refused} refused by the host`],
  ]
  const said = parts.filter(([n]) => n > 0).map(([, words]) => words)
  return [`${tally.agrees} right`, ...said].join(', ')
}

export const asked = (tally: Tally) =>
  tally.agrees + tally.misses + tally.false_alarms + tally.distances + tally.unsteady + tally.broken + tally.unsupported
export const failed = (tally: Tally) => tally.misses + tally.false_alarms + tally.distances + tally.unsteady + tally.broken

function familyCell(found: FamilyResult): Cell {
  const { tally, state } = found
  const counts: Record<CellState, string> = {
    agrees: '',
    slow: String(tally.slow),
    // Missed collisions first: they are the worst.
    wrong: tally.misses > 0 ? `${tally.misses}+${failed(tally) - tally.misses}` : String(failed(tally)),
    broken: String(tally.broken),
    unsupported: '',
    refused: '',
  }
  return { state, count: counts[state], words: tallyWords(tally) }
}

function relationCell(found: RelationResult): Cell {
  const broken = found.decisions + found.distances
  const state = found.tried === 0 ? 'unsupported' : broken > 0 ? 'wrong' : 'agrees'
  const words = `${plural(found.decisions, 'decision differs', 'decisions differ')} and ${plural(found.distances, 'distance differs', 'distances differ')} of ${found.tried}`
  return { state, count: broken > 0 ? `${found.decisions}/${found.distances}` : '', words }
}

/** What stands above the columns of a view. */
export function columns(table: StabilityTable, view: View): Column[] {
  if (view === 'families') return table.families
  if (view === 'relations') return table.relations.map((relation) => ({ ...relation, beyond: false }))
  return table.failures.map(({ id, source, seen }) => ({ id, name: source, sentence: seen, beyond: false }))
}

/** The views that have a column. */
export const views = (table: StabilityTable): View[] => VIEWS.filter((view) => columns(table, view).length > 0)

/** The table of one result alone, without what was not tried. */
export function tableOf(result: Stability, { families, relations, failures }: Omit<StabilityTable, 'methods'>): StabilityTable {
  return {
    families: families.filter(({ id }) => result.families.some(({ family }) => family === id)),
    relations: relations.filter(({ id }) => result.relations.some(({ relation }) => relation === id)),
    failures: failures.filter(({ id }) => result.failures.some((failure) => failure.id === id)),
    methods: [result],
  }
}

/** The cell of a method in a column; null where it was not tried. */
export function cell(method: Stability, view: View, id: string): Cell | null {
  if (view === 'families') {
    const found = method.families.find(({ family }) => family === id)
    return found ? familyCell(found) : null
  }
  if (view === 'relations') {
    const found = method.relations.find(({ relation }) => relation === id)
    return found ? relationCell(found) : null
  }
  const found = method.failures.find((failure) => failure.id === id)
  return found ? { state: found.state, count: '', words: found.got } : null
}

/** How many columns within the promise are free of wrong answers, of those that were answered. */
export function passed(method: Stability, table: StabilityTable, view: View): { good: number; of: number } {
  const counted = columns(table, view).filter(({ beyond }) => !beyond)
  const cells = counted.flatMap(({ id }) => cell(method, view, id) ?? [])
  const answered = cells.filter(({ state }) => state !== 'unsupported' && state !== 'refused')
  return { good: answered.filter(({ state }) => state === 'agrees' || state === 'slow').length, of: answered.length }
}

/** A number as short as it can be read back: 1e-7, 0.25, 1,048,576. */
export function short(value: number): string {
  const size = Math.abs(value)
  if (size !== 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(2).replace(/\.?0+e/, 'e').replace('e+', 'e')
  return Number(value.toPrecision(4)).toLocaleString('en-GB', { maximumSignificantDigits: 7 })
}
