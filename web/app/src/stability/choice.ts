import type { StabilityRunInfo, StabilitySpec, StabilityTable, SuiteInfo } from '../api/types'

/** What a stability run tests, as one choice of a list. */
export interface Choice {
  value: string
  name: string
}

type Parts = Pick<StabilityTable, 'families' | 'relations'>

const ALL = 'all'
const FAMILIES = 'families'
const RELATIONS = 'relations'
/** The parts that are neither families nor relations. */
const OTHERS: readonly Choice[] = [
  { value: 'reported', name: 'Reported failures' },
  { value: 'tessellations', name: 'The same surface with other triangles' },
  { value: 'search', name: 'Adversarial search' },
]

const choice = ({ id, name }: { id: string; name: string }): Choice => ({ value: id, name })

/** The choices in groups; the first one, everything, belongs to none. */
export function choices({ families, relations }: Parts): { all: Choice; groups: { label: string; choices: Choice[] }[] } {
  return {
    all: { value: ALL, name: 'Everything' },
    groups: [
      { label: 'Stress families', choices: [{ value: FAMILIES, name: 'All stress families' }, ...families.map(choice)] },
      { label: 'Relations between answers', choices: [{ value: RELATIONS, name: 'All relations' }, ...relations.map(choice)] },
      { label: 'Other tests', choices: [...OTHERS] },
    ],
  }
}

/** The parts of a choice, as the API reads them; none stands for everything. */
export function partsOf(chosen: string, { families, relations }: Parts): string[] {
  if (chosen === ALL) return []
  if (chosen === FAMILIES) return families.map(({ id }) => id)
  if (chosen === RELATIONS) return relations.map(({ id }) => id)
  return [chosen]
}

/** The name of a part. */
export function partName(id: string, { families, relations }: Parts): string {
  return [...families, ...relations].find((part) => part.id === id)?.name ?? OTHERS.find(({ value }) => value === id)?.name ?? id
}

/** What a run tests, in words. */
export function tested({ parts = [] }: StabilitySpec, table: Parts): string {
  if (parts.length === 0) return 'everything'
  if (parts.length === 1) return partName(parts[0] ?? '', table)
  const same = (all: readonly { id: string }[]) => all.length === parts.length && all.every(({ id }) => parts.includes(id))
  if (same(table.families)) return 'all stress families'
  if (same(table.relations)) return 'all relations'
  return `${parts.length} tests`
}

export const isOpen = ({ state }: Pick<StabilityRunInfo, 'state'>): boolean => state === 'queued' || state === 'running'

/** How far it is, in a sentence. */
export function progressWords(run: StabilityRunInfo, table: Parts): string {
  if (run.state === 'queued') {
    return run.runs_ahead === 0 ? 'Next stability run in the queue.' : `${run.runs_ahead} stability ${run.runs_ahead === 1 ? 'run' : 'runs'} ahead in the queue.`
  }
  return `${run.done} of ${run.total} tests done${run.step == null ? '' : `; now: ${partName(run.step, table)}`}.`
}

/** How many public algorithms have no row in the table, and how they get one; null when all have. */
export function untestedWords(methods: StabilityTable['methods'], { progress, idle }: Pick<SuiteInfo, 'progress' | 'idle'>): string | null {
  const without = progress.filter((one) => methods.every(({ algorithm }) => algorithm !== one.algorithm)).length
  if (without === 0) return null
  const none = 'No algorithm has been tested yet.'
  const some = `${without} ${without === 1 ? 'algorithm has' : 'algorithms have'} not been tested yet.`
  const how = idle ? 'This service tests installed algorithms when it is idle.' : 'Start a test of everything to add one to the table.'
  return `${without === progress.length ? none : some} ${how}`
}
