import type { PairTime } from '../api/types'
import { colourAt } from '../explorer/colormap'
import { count, percent } from '../ui/format'

/** What the colour of a pair shows. */
export type Shown = 'time' | 'hits' | 'wrong'

export const SHOWN: Record<Shown, string> = { time: 'Share of the time', hits: 'Share of colliding queries', wrong: 'Wrong answers' }

/** As many objects as a matrix has at most. */
export const MOST_OBJECTS = 40

export interface Cell {
  pair: PairTime
  value: number
  /** Between 0 and 1 on the colour scale. */
  position: number
}

export interface Matrix {
  /** Objects by their place in the scene: each row against each column. */
  rows: number[]
  columns: number[]
  cell: (row: number, column: number) => Cell | null
  /** Values at the ends of the scale; null where none is shown. */
  ends: [number, number] | null
  /** Values below the low end have its colour. */
  cut: boolean
  /** What does not fit in. */
  remainder: { objects: number; pairs: number; share: number } | null
}

const key = (objects: readonly number[]) => `${Math.min(...objects)} ${Math.max(...objects)}`

/** A value of a pair: shares of the time of all pairs, of its queries that collide; a number of wrong answers. */
export function valueOf(pair: PairTime, shown: Shown, all: number): number {
  if (shown === 'time') return all > 0 ? pair.ns / all : 0
  if (shown === 'wrong') return pair.wrong
  return pair.n > 0 ? pair.hits / pair.n : 0
}

export const valueWords = (value: number, shown: Shown): string => (shown === 'wrong' ? count(value) : percent(value))

/** The pairs as a matrix, of at most `MOST_OBJECTS` objects: those with most of the time. */
export function matrix(pairs: readonly PairTime[], shown: Shown): Matrix {
  const all = pairs.reduce((sum, { ns }) => sum + ns, 0)
  const time = new Map<number, number>()
  for (const { objects, ns } of pairs) for (const one of new Set(objects)) time.set(one, (time.get(one) ?? 0) + ns)
  const dearest = [...time].toSorted(([a, x], [b, y]) => y - x || a - b).map(([one]) => one)
  const kept = new Set(dearest.slice(0, MOST_OBJECTS))
  const inside = pairs.filter(({ objects }) => objects.every((one) => kept.has(one)))
  const position = scale(inside.map((pair) => valueOf(pair, shown, all)), shown)
  const cells = new Map(inside.map((pair) => {
    const value = valueOf(pair, shown, all)
    return [key(pair.objects), { pair, value, position: position.at(value) }]
  }))
  const ascending = (places: Iterable<number>) => [...new Set(places)].toSorted((a, b) => a - b)
  const rows = ascending(inside.map(({ objects }) => Math.min(...objects)))
  const columns = ascending(inside.map(({ objects }) => Math.max(...objects)))
  const outside = pairs.length - inside.length
  return {
    rows, columns, ends: position.ends, cut: position.ends !== null && inside.some((pair) => valueOf(pair, shown, all) < (position.ends?.[0] ?? 0)),
    // Each pair is in the matrix once: the object that stands first in the scene is the row.
    cell: (row, column) => (row <= column ? (cells.get(key([row, column])) ?? null) : null),
    remainder: outside === 0 ? null : {
      objects: dearest.length - kept.size, pairs: outside, share: all > 0 ? 1 - inside.reduce((sum, { ns }) => sum + ns, 0) / all : 0,
    },
  }
}

/** Decades that the scale of shares of time has at most: what takes less is as dark as that. */
const DECADES = 3

/** Shares of time on a logarithmic scale, because a few pairs take most of it; the others on a linear one from 0. */
function scale(values: readonly number[], shown: Shown): { at: (value: number) => number; ends: [number, number] | null } {
  const hi = Math.max(0, ...values)
  if (values.length === 0) return { at: () => 0, ends: null }
  if (shown !== 'time') {
    const end = shown === 'hits' ? 1 : Math.max(1, hi)
    return { at: (value) => value / end, ends: [0, end] }
  }
  if (hi === 0) return { at: () => 0, ends: null }
  const least = Math.min(...values.filter((value) => value > 0))
  const lo = Math.max(least < hi ? least : hi / 10, hi / 10 ** DECADES)
  const at = (value: number) => (value <= lo ? 0 : Math.min(1, Math.log(value / lo) / Math.log(hi / lo)))
  return { at, ends: [lo, hi] }
}

/** Background of a cell, and ink that reads on it. */
export function paint(position: number): { background: string; color: string } {
  const background = colourAt('cividis', position)
  const [r = 0, g = 0, b = 0] = (background.match(/[\d.]+/g) ?? []).map((part) => {
    const level = Number(part) / 255
    return level <= 0.04045 ? level / 12.92 : ((level + 0.055) / 1.055) ** 2.4
  })
  return { background, color: 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? '#000000' : '#ffffff' }
}

/** The number in a cell: percent without its sign, which the legend has. */
export function cellText(value: number, shown: Shown): string {
  if (shown === 'wrong') return value > 999 ? `${Math.round(value / 1000)}k` : String(value)
  const share = 100 * value
  return share > 0 && share < 1 ? '<1' : String(Math.round(share))
}
