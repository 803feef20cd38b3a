import type { LocationQuery } from 'vue-router'
import type { BoardQuery } from '../api/client'
import type { Accuracy, BoardFilter } from '../api/types'
import { ACCURACY } from '../ui/words'

/** The filters in the order in which the service applies them. */
export const FILTERS = ['suite', 'question', 'class', 'hardware', 'scene', 'distance', 'precision'] as const
export type FilterName = (typeof FILTERS)[number]

/** What the address asks for; what it does not say, the service chooses. */
export function readQuery(query: LocationQuery): BoardQuery {
  const said = FILTERS.flatMap((name) => {
    const value = query[name]
    return typeof value === 'string' && value !== '' ? [[name, value] as const] : []
  })
  const { accuracy } = query
  const known = typeof accuracy === 'string' && accuracy in ACCURACY && accuracy !== 'wrong'
  return { ...Object.fromEntries(said), ...(known && { accuracy: accuracy as Accuracy }) }
}

/** The address after a choice. A filter decides what those after it can be, so those are chosen anew; the precision stays. */
export function withChoice(query: BoardQuery, name: FilterName, value: string | null): BoardQuery {
  const place = FILTERS.indexOf(name)
  const kept = Object.entries(query).filter(([key]) => {
    const at = FILTERS.indexOf(key as FilterName)
    return at < place || key === 'precision'
  })
  const { [name]: _, ...rest } = Object.fromEntries(kept)
  return value === null ? rest : { ...rest, [name]: value }
}

/** The filters that took something away, for an empty board. */
export function takers(filters: readonly BoardFilter[]): { name: FilterName; words: string; removed: number }[] {
  return filters.flatMap(({ name, chosen, options, removed }) =>
    removed === 0 ? [] : [{ name: name as FilterName, words: options.find(({ value }) => value === chosen)?.words ?? chosen, removed }],
  )
}
