import type { PosedScene, ScenePair } from '../api/types'
import { count } from '../ui/format'

/** Which pairs are listed. */
export type Listed = 'all' | 'asked' | 'disabled'

export const LISTED: Record<Listed, string> = { all: 'All', asked: 'Asked', disabled: 'Disabled' }

/** Objects that are drawn at most: each is a file of its own. */
export const MOST_DRAWN = 200

export const isListed = ({ queries, disabled }: ScenePair, which: Listed): boolean =>
  which === 'all' || (which === 'asked' ? queries > 0 : disabled != null)

/** What becomes of a pair, in a few words. */
export function pairState({ queries, disabled }: ScenePair): string {
  const asked = queries > 0 ? `asked ${queries === 1 ? 'once' : `${count(queries)} times`}` : 'not asked'
  return disabled == null ? asked : `disabled (${disabled})${queries > 0 ? `, but ${asked}` : ''}`
}

/** The pairs of a scene by what becomes of them, in a sentence or two. */
export function pairsWords({ objects, asked, disabled, asked_though_disabled: both }: PosedScene): string {
  const all = (objects.length * (objects.length - 1)) / 2
  if (asked === 0) {
    const off = disabled === 0 ? 'None is disabled' : `${count(disabled)} ${disabled === 1 ? 'is' : 'are'} disabled`
    return `${count(all)} ${all === 1 ? 'pair' : 'pairs'} of objects. ${off}.`
  }
  const rest = Math.max(0, all - asked - disabled + both)
  const off = disabled === 0 ? 'The recording disables none' : `${count(disabled)} ${disabled === 1 ? 'is' : 'are'} disabled${both > 0 ? `, of which ${count(both)} ${both === 1 ? 'was' : 'were'} asked all the same` : ''}`
  const neither = rest === 0 ? '' : `; ${count(rest)} ${rest === 1 ? 'is' : 'are'} neither`
  return `${count(asked)} of ${count(all)} ${all === 1 ? 'pair was' : 'pairs were'} asked. ${off}${neither}.`
}

/** The objects that are drawn: all of a scene that is not too large, else those of the chosen pair and those that were asked most. */
export function drawnOf({ objects, pairs }: PosedScene, chosen: readonly number[] | null): PosedScene['objects'] {
  const lit = new Set(chosen ?? [])
  const first = [...lit, ...pairs.flatMap(({ objects: both }) => both), ...objects.map(({ object }) => object)]
  const kept = new Set([...new Set(first)].slice(0, MOST_DRAWN))
  return objects.filter(({ object }) => kept.has(object))
}
