/** The language of selections, as `host/core/src/selection.rs` defines it; `cases.json` there holds both to the same. */

export const COLUMNS = [
  'time', 'bv', 'primitives', 'error', 'distance', 'wrong', 'missed', 'false_alarm', 'flipped', 'disputed',
] as const
export type Column = (typeof COLUMNS)[number]
const FLAGS: ReadonlySet<Column> = new Set(['wrong', 'missed', 'false_alarm', 'flipped', 'disputed'])

export type Predicate =
  | { kind: 'range'; column: Column; of: string | null; lo: number; hi: number }
  | { kind: 'flag'; column: Column; of: string | null }
  | { kind: 'near'; body: 'a' | 'b'; vertex: number; radius: number }
  | { kind: 'not'; one: Predicate }
  | { kind: 'all' | 'any'; all: Predicate[] }

/** Why a text is no selection; `at` counts characters from 1. */
export class SelectionError extends Error {
  constructor(readonly at: number, readonly what: string) {
    super(`The selection cannot be read at character ${at}: ${what}.`)
  }
}

const LONGEST = 2000
const DEEPEST = 40
const TIME_UNITS: Readonly<Record<string, number>> = { '': 1, ns: 1, us: 1e3, ms: 1e6, s: 1e9 }
const LETTERS = /[A-Za-z]/
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?/

/** Reads a selection, or throws a `SelectionError`. */
export function parse(text: string): Predicate {
  const reader = new Reader([...text])
  if (reader.text.length > LONGEST) reader.wrong(`it is longer than ${LONGEST} characters`)
  const all = reader.any()
  reader.space()
  if (reader.at < reader.text.length) reader.wrong('"&", "|" or the end is expected')
  return all
}

class Reader {
  at = 0
  private depth = 0

  constructor(readonly text: readonly string[]) {}

  any(): Predicate {
    return this.many('|', 'any', () => this.many('&', 'all', () => this.one()))
  }

  private many(sign: string, kind: 'all' | 'any', next: () => Predicate): Predicate {
    const first = next()
    const all = [first]
    while (this.take(sign)) all.push(next())
    return all.length === 1 ? first : { kind, all }
  }

  private one(): Predicate {
    this.depth++
    if (this.depth > DEEPEST) this.wrong(`brackets and negations nest deeper than ${DEEPEST}`)
    let found: Predicate
    if (this.take('!')) found = { kind: 'not', one: this.one() }
    else if (this.take('(')) {
      found = this.any()
      this.expect(')')
    } else found = this.test()
    this.depth--
    return found
  }

  private test(): Predicate {
    this.space()
    const begin = this.at
    const word = this.word(/[A-Za-z_]/)
    if (word === 'near') return this.near()
    const column = COLUMNS.find((name) => name === word)
    if (!column) {
      this.at = begin
      return this.wrong(`one of ${COLUMNS.join(', ')}, near(...), "!" or "(" is expected`)
    }
    const of = this.of()
    if (FLAGS.has(column)) return { kind: 'flag', column, of }
    this.keyword('in')
    this.expect('[')
    const lo = this.amount(column)
    this.expect(',')
    const hi = this.amount(column)
    if (lo > hi) this.wrong('the first end of the range is above the second')
    this.expect(']')
    return { kind: 'range', column, of, lo, hi }
  }

  private near(): Predicate {
    this.expect('(')
    this.space()
    const begin = this.at
    const word = this.word(LETTERS)
    if (word !== 'a' && word !== 'b') this.at = begin
    this.keyword('vertex')
    this.space()
    const digits = this.word(/\d/)
    const vertex = Number(digits)
    if (digits === '' || vertex > 0xffff_ffff) this.wrong('the number of a vertex, counted from 0, is expected')
    this.expect(',')
    const radius = this.number()
    if (radius < 0) this.wrong('a radius cannot be negative')
    this.expect(')')
    return { kind: 'near', body: word === 'b' ? 'b' : 'a', vertex, radius }
  }

  private of(): string | null {
    const begin = this.at
    this.space()
    if (this.word(LETTERS) !== 'of') {
      this.at = begin
      return null
    }
    this.space()
    return this.word(/[A-Za-z0-9\-_.:=+]/) || this.wrong('the id of an algorithm is expected')
  }

  private amount(column: Column): number {
    const number = this.number()
    const begin = this.at
    const unit = this.word(LETTERS)
    const factor = column === 'time' || unit === '' ? TIME_UNITS[unit] : undefined
    if (factor !== undefined) return number * factor
    this.at = begin
    return this.wrong(`${column} takes ${column === 'time' ? 'ns, us, ms or s' : 'no unit'}`)
  }

  private number(): number {
    this.space()
    const found = NUMBER.exec(this.text.slice(this.at, this.at + 400).join(''))?.[0] ?? ''
    const number = Number(found)
    if (found === '' || !Number.isFinite(number)) this.wrong('a number is expected')
    this.at += found.length
    return number
  }

  private keyword(wanted: string): void {
    this.space()
    const begin = this.at
    if (this.word(LETTERS) === wanted) return
    this.at = begin
    this.wrong(`"${wanted}" is expected`)
  }

  private expect(sign: string): void {
    if (!this.take(sign)) this.wrong(`"${sign}" is expected`)
  }

  private take(sign: string): boolean {
    this.space()
    const there = this.text[this.at] === sign
    if (there) this.at++
    return there
  }

  private word(belongs: RegExp): string {
    const begin = this.at
    while (this.at < this.text.length && belongs.test(this.text[this.at] ?? '')) this.at++
    return this.text.slice(begin, this.at).join('')
  }

  space(): void {
    while (this.at < this.text.length && /\s/.test(this.text[this.at] ?? '')) this.at++
  }

  wrong(what: string): never {
    throw new SelectionError(this.at + 1, what)
  }
}

/** The shortest text that reads as the same selection. */
export function write(predicate: Predicate): string {
  switch (predicate.kind) {
    case 'range':
      return `${predicate.column}${whose(predicate.of)} in [${predicate.lo}, ${predicate.hi}]`
    case 'flag':
      return `${predicate.column}${whose(predicate.of)}`
    case 'near':
      return `near(${predicate.body === 'b' ? 'b ' : ''}vertex ${predicate.vertex}, ${predicate.radius})`
    case 'not':
      return `!${bracketed(predicate.one, ['all', 'any'])}`
    case 'all':
      return predicate.all.map((one) => bracketed(one, ['all', 'any'])).join(' & ')
    case 'any':
      return predicate.all.map((one) => bracketed(one, ['any'])).join(' | ')
  }
}

const whose = (of: string | null) => (of === null ? '' : ` of ${of}`)

function bracketed(one: Predicate, kinds: Predicate['kind'][]): string {
  return kinds.includes(one.kind) ? `(${write(one)})` : write(one)
}

/** The algorithms that a selection names, and whether it means the one that is looked at. */
export function algorithms(predicate: Predicate, lookedAt: string): string[] {
  switch (predicate.kind) {
    case 'range':
    case 'flag':
      return predicate.column === 'distance' ? [] : [predicate.of ?? lookedAt]
    case 'near':
      return []
    case 'not':
      return algorithms(predicate.one, lookedAt)
    default:
      return [...new Set(predicate.all.flatMap((one) => algorithms(one, lookedAt)))]
  }
}
