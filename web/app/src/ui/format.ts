import type { Estimated } from '../api/types'

/** Narrow no-break space between a number and its unit. */
const GAP = '\u202f'

const TIME_UNITS: [number, string][] = [[1, 'ns'], [1e3, 'µs'], [1e6, 'ms'], [1e9, 's']]
const BYTE_UNITS: [number, string][] = [[1, 'B'], [1024, 'KiB'], [1024 ** 2, 'MiB'], [1024 ** 3, 'GiB']]

/** Three significant digits without exponents: 0.0123, 1.23, 123, 12,300. */
export function significant(amount: number, digits = 3): string {
  if (amount === 0) return '0'
  if (Math.abs(amount) >= 10 ** digits) return Math.round(amount).toLocaleString('en-GB')
  return Number(amount.toPrecision(digits)).toLocaleString('en-GB', { maximumSignificantDigits: digits, useGrouping: true })
}

/** A count, exactly: 12,345. */
export function count(amount: number): string {
  return Math.round(amount).toLocaleString('en-GB')
}

/** A duration given in nanoseconds, in the unit that reads best. */
export function time(ns: number): string {
  const [factor, unit] = unitFor(ns, TIME_UNITS)
  return significant(ns / factor) + GAP + unit
}

/** A value of a heatmap; `unit` as the API names it. */
export function value(amount: number, unit: string): string {
  if (unit === 'ns') return time(amount)
  if (unit === 'share') return percent(amount)
  if (amount === 1) return `1${GAP}${unit.replace(/s$/, '')}`
  if (Number.isInteger(amount)) return `${count(amount)}${GAP}${unit}`
  return significant(amount) + GAP + unit
}

/** Several values with one unit between them, for the ticks of a legend. */
export function inOneUnit(amounts: readonly number[], unit: string): { unit: string; texts: string[] } {
  if (unit === 'share') return { unit: '%', texts: amounts.map((amount) => significant(amount * 100)) }
  if (unit !== 'ns') return { unit, texts: amounts.map((amount) => significant(amount)) }
  // The middle of the axis decides: a few zeros at one end, a few decimals at the other.
  const positive = amounts.filter((amount) => amount > 0)
  const middle = Math.sqrt(Math.min(...positive) * Math.max(...positive))
  const [factor, name] = unitFor(positive.length > 0 ? middle : 1, TIME_UNITS)
  return { unit: name, texts: amounts.map((amount) => significant(amount / factor)) }
}

/** An estimate and its interval, both in one unit: `12.3 µs`, `12.1–12.6`. */
export function estimated(estimate: Estimated): { value: string; interval: string } {
  const [factor, unit] = unitFor(estimate.value, TIME_UNITS)
  const text = (ns: number) => significant(ns / factor)
  return { value: text(estimate.value) + GAP + unit, interval: `${text(estimate.lo)}–${text(estimate.hi)}` }
}

/** Memory. */
export function bytes(amount: number): string {
  const [factor, unit] = unitFor(amount, BYTE_UNITS)
  return significant(amount / factor) + GAP + unit
}

/** A span that a person waits for. */
export function seconds(span: number): string {
  if (span < 1) return `under 1${GAP}s`
  if (span < 90) return `${Math.round(span)}${GAP}s`
  if (span < 5400) return `${Math.round(span / 60)}${GAP}min`
  return `${significant(span / 3600, 2)}${GAP}h`
}

/** A share as a percentage. */
export function percent(share: number): string {
  return `${significant(share * 100)}${GAP}%`
}

/** Wrong answers among n: the bound is the rule of three, 95 %. */
export function wrongAnswers(wrong: number, n: number): string {
  if (wrong > 0) return `${count(wrong)} in ${count(n)}`
  return n > 0 ? `none in ${count(n)}` : 'nothing answered'
}

/** Date and time of day of a microsecond stamp, in the reader's zone. */
export function moment(us: number): string {
  return new Date(us / 1000).toLocaleString('en-GB', { dateStyle: 'medium', timeStyle: 'short' })
}

function unitFor(amount: number, units: [number, string][]): [number, string] {
  const [first = [1, '']] = units
  return units.findLast(([factor]) => Math.abs(amount) >= factor) ?? first
}
