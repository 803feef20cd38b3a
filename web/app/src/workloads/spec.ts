import type { AlgorithmInfo } from '../api/types'
import type { ObjectHeatmapRequest, ReduceTerms, Track, WorkloadResult, WorkloadSpec } from '../api/types'
import { quote } from '../builder/command-line'
import { plainId } from '../builder/form'

export type Orders = 'all' | Track

const TRACKS: Track[] = ['shuffled', 'recorded', 'scene']

/** What the reader has chosen; number fields may be empty while they type. */
export interface SpecForm {
  /** Names of algorithms; null: the usual ones. */
  algorithms: string[] | null
  orders: Orders
  passes: number | ''
  budget: number | ''
  reduce: ReduceForm
}

/** The simplest scene that keeps the answers. */
export interface ReduceForm {
  wanted: boolean
  /** Lengths in the unit of the scene. */
  tolerance: number | ''
  near: number | ''
  outsideOnly: boolean
  /** Also for other tolerances. */
  frontier: boolean
}

export const usualForm = (): SpecForm => ({
  algorithms: null, orders: 'all', passes: 3, budget: 10, reduce: { wanted: false, tolerance: 0.001, near: 0, outsideOnly: false, frontier: false },
})

/** The names that are chosen, or the usual ones. */
export const chosenNames = ({ algorithms }: SpecForm, known: readonly AlgorithmInfo[]): string[] =>
  algorithms ?? known.filter(({ usual }) => usual).map(({ id }) => id)

/** The form as the API wants it, or what is wrong with it, in a sentence. */
export function toSpec({ algorithms, orders, passes, budget, reduce }: SpecForm): { spec: WorkloadSpec } | { problem: string } {
  if (algorithms?.length === 0) return { problem: 'Choose at least one algorithm.' }
  if (passes === '' || !Number.isInteger(passes) || passes < 1 || passes > 64) return { problem: 'The number of processes must be a whole number from 1 to 64.' }
  if (budget === '' || !(budget > 0 && budget <= 86_400)) return { problem: 'The budget must be above 0 and at most 86,400 seconds.' }
  const terms = toTerms(reduce)
  if (terms && 'problem' in terms) return terms
  return { spec: { algorithms: algorithms ?? [], tracks: orders === 'all' ? TRACKS : [orders], passes, budget_seconds: budget, seed: null, reduce: terms } }
}

function toTerms({ wanted, tolerance, near, outsideOnly, frontier }: ReduceForm): ReduceTerms | { problem: string } | null {
  if (!wanted) return null
  if (tolerance === '' || !(tolerance > 0)) return { problem: 'The tolerance must be above 0.' }
  if (near === '' || !(near >= 0 && 2 * near < tolerance)) return { problem: 'The neighbourhood must be 0 or more, and less than half of the tolerance.' }
  return { tolerance, near, outside_only: outsideOnly, frontier }
}

/** The form that would ask for a replay again, as far as its algorithms are still installed. */
export function fromSpec(spec: Partial<WorkloadSpec>, known: readonly AlgorithmInfo[]): SpecForm {
  const form = usualForm()
  const wanted = (spec.algorithms ?? []).flatMap((name) => (name === 'all' ? known.map(({ id }) => id) : [name]))
  const there = wanted.filter((name) => known.some(({ id }) => id === plainId(name)))
  const [only, other] = spec.tracks ?? []
  return {
    algorithms: there.length > 0 ? there : null,
    orders: only && !other ? only : 'all',
    passes: spec.passes ?? form.passes,
    budget: spec.budget_seconds ?? form.budget,
    reduce: spec.reduce ? { wanted: true, tolerance: spec.reduce.tolerance, near: spec.reduce.near ?? 0, outsideOnly: spec.reduce.outside_only ?? false, frontier: spec.reduce.frontier ?? false } : form.reduce,
  }
}

/** A heatmap of an object on the command line, from the recording and the table of its replay. */
export function heatmapCommand(file: string, table: string, object: string, { algorithm, order, measure, from, to }: ObjectHeatmapRequest): string {
  return [
    `ocb scene heatmap ${quote(file)} ${quote(table)}`,
    `--object ${quote(object)} --algorithm ${quote(algorithm)} --order ${order} --measure ${measure}`,
    ...(from == null ? [] : [`--from ${from}`]),
    ...(to == null ? [] : [`--to ${to}`]),
    '--output heatmap.ply',
  ].join(' \\\n  ')
}

/** The same replay on the command line, with the seed that was used. */
export function commandLine(file: string, spec: Partial<WorkloadSpec>, result: Pick<WorkloadResult, 'seed'> | null): string {
  const { algorithms = [], tracks = [], passes, budget_seconds: budget } = spec
  const seed = result?.seed ?? spec.seed
  return [
    `ocb bench --workload ${quote(file)}`,
    ...(algorithms.length > 0 ? [`--algorithm ${algorithms.map(quote).join(',')}`] : []),
    ...(tracks.length === 0 || tracks.length === TRACKS.length ? [] : [`--order ${tracks.join(',')}`]),
    ...(passes === undefined ? [] : [`--passes ${passes}`]),
    ...(budget === undefined ? [] : [`--budget ${budget}`]),
    ...(seed == null ? [] : [`--run-seed ${seed}`]),
  ].join(' \\\n  ')
}
