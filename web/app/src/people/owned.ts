import type { OwnedCounts, OwnedItems } from '../api/types'
import { bytes, count } from '../ui/format'

const several = (n: number, one: string, more: string): string[] => (n === 0 ? [] : [`${count(n)} ${n === 1 ? one : more}`])

/** How many of each, as the part of a sentence; null when there is nothing. */
export function counted({ runs, objects, configurations, advice, stability, workloads, plugins }: OwnedCounts): string | null {
  const parts = [
    ...several(runs, 'run', 'runs'),
    ...several(objects, 'object', 'objects'),
    ...several(configurations, 'saved set of configurations', 'saved sets of configurations'),
    ...several(advice, 'piece of advice', 'pieces of advice'),
    ...several(stability, 'stability run', 'stability runs'),
    ...several(workloads, 'replayed recording', 'replayed recordings'),
    ...several(plugins, 'plugin', 'plugins'),
  ]
  const last = parts.pop()
  if (last === undefined) return null
  return parts.length > 0 ? `${parts.join(', ')} and ${last}` : last
}

/** What goes, as a sentence. */
export function inWords({ runs, objects, configurations, advice, stability, workloads, bytes: size }: Omit<OwnedItems, 'kept_until_us'>): string {
  const all = counted({ runs: runs.length, objects: objects.length, configurations: configurations.length, advice, stability, workloads, plugins: 0 })
  if (all === null) return 'There is nothing to delete.'
  return `${all} will be deleted permanently${size > 0 ? `, with ${bytes(size)} of files that nothing else uses` : ''}.`
}
