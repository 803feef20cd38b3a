import type { AlgorithmInfo } from '../api/types'
import type { Track, WorkloadResult, WorkloadSpec } from '../api/types'
import { quote } from '../builder/command-line'
import { plainId } from '../builder/form'

export type Orders = 'both' | Track

/** What the reader has chosen; number fields may be empty while they type. */
export interface SpecForm {
  /** Names of algorithms; null: the usual ones. */
  algorithms: string[] | null
  orders: Orders
  passes: number | ''
  budget: number | ''
}

export const usualForm = (): SpecForm => ({ algorithms: null, orders: 'both', passes: 3, budget: 10 })

/** The names that are chosen, or the usual ones. */
export const chosenNames = ({ algorithms }: SpecForm, known: readonly AlgorithmInfo[]): string[] =>
  algorithms ?? known.filter(({ usual }) => usual).map(({ id }) => id)

/** The form as the API wants it, or what is wrong with it, in a sentence. */
export function toSpec({ algorithms, orders, passes, budget }: SpecForm): { spec: WorkloadSpec } | { problem: string } {
  if (algorithms?.length === 0) return { problem: 'Choose at least one algorithm.' }
  if (passes === '' || !Number.isInteger(passes) || passes < 1 || passes > 64) return { problem: 'The number of processes must be a whole number from 1 to 64.' }
  if (budget === '' || !(budget > 0 && budget <= 86_400)) return { problem: 'The budget must be above 0 and at most 86,400 seconds.' }
  return { spec: { algorithms: algorithms ?? [], tracks: orders === 'both' ? ['shuffled', 'recorded'] : [orders], passes, budget_seconds: budget, seed: null } }
}

/** The form that would ask for a replay again, as far as its algorithms are still installed. */
export function fromSpec(spec: Partial<WorkloadSpec>, known: readonly AlgorithmInfo[]): SpecForm {
  const form = usualForm()
  const wanted = (spec.algorithms ?? []).flatMap((name) => (name === 'all' ? known.map(({ id }) => id) : [name]))
  const there = wanted.filter((name) => known.some(({ id }) => id === plainId(name)))
  const [only, other] = spec.tracks ?? []
  return {
    algorithms: there.length > 0 ? there : null,
    orders: only && !other ? only : 'both',
    passes: spec.passes ?? form.passes,
    budget: spec.budget_seconds ?? form.budget,
  }
}

/** The same replay on the command line, with the seed that was used. */
export function commandLine(file: string, spec: Partial<WorkloadSpec>, result: Pick<WorkloadResult, 'seed'> | null): string {
  const { algorithms = [], tracks = [], passes, budget_seconds: budget } = spec
  const seed = result?.seed ?? spec.seed
  return [
    `ocb bench --workload ${quote(file)}`,
    ...(algorithms.length > 0 ? [`--algorithm ${algorithms.map(quote).join(',')}`] : []),
    ...(tracks.length === 1 ? [`--order ${tracks[0]}`] : []),
    ...(passes === undefined ? [] : [`--passes ${passes}`]),
    ...(budget === undefined ? [] : [`--budget ${budget}`]),
    ...(seed == null ? [] : [`--run-seed ${seed}`]),
  ].join(' \\\n  ')
}
