import type { Things } from '../api/types'
import { bytes, count } from '../ui/format'

const several = (n: number, one: string, more: string): string[] => (n === 0 ? [] : [`${count(n)} ${n === 1 ? one : more}`])

/** What goes, as a sentence. */
export function inWords({ runs, objects, advice, bytes: size }: Pick<Things, 'runs' | 'objects' | 'advice' | 'bytes'>): string {
  const parts = [
    ...several(runs.length, 'run', 'runs'),
    ...several(objects.length, 'object', 'objects'),
    ...several(advice, 'piece of advice', 'pieces of advice'),
  ]
  const last = parts.pop()
  if (last === undefined) return 'There is nothing to delete.'
  const all = parts.length > 0 ? `${parts.join(', ')} and ${last}` : last
  return `${all} will be gone for good${size > 0 ? `, with ${bytes(size)} of files that nobody else uses` : ''}.`
}
