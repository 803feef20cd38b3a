import type { AlgorithmResult } from '../api/types'
import { count, percent, significant } from '../ui/format'

/** eps* as the table shows it: a value, or with "<" the bound when no error was seen; never 0. */
export function epsilon({ resolution }: AlgorithmResult): string {
  if (resolution?.eps == null) return '–'
  return (resolution.seen ? '' : '< ') + resolution.eps.toExponential(1)
}

/** What is behind eps*, in words; empty when there is nothing to say. */
export function resolutionNotes({ resolution, grazing, contacts }: AlgorithmResult): string[] {
  const notes: string[] = []
  if (resolution) {
    const { false_hits: hits, misses, distance } = resolution
    if (hits.wrong > 0) notes.push(`reports a hit for ${count(hits.wrong)} of ${count(hits.n)} apart`)
    if (misses.wrong > 0) notes.push(`misses ${count(misses.wrong)} of ${count(misses.n)} crossing`)
    if (distance) {
      const worst = (error: number | null | undefined) => (error == null ? 'none' : `${significant(error)} u S`)
      notes.push(`distances too long by: ${worst(distance.over)}, too short by: ${worst(distance.under)}`)
    }
  }
  if (grazing && grazing.n > 0) notes.push(`grazing: ${count(grazing.agree)} of ${count(grazing.n)} agree with exact arithmetic`)
  if (contacts) {
    const share = (x: number | null | undefined) => (x == null ? '–' : percent(x))
    notes.push(`contacts: precision ${share(contacts.precision)}, recall ${share(contacts.recall)}`)
  }
  return notes
}
