import type { AlgorithmInfo, Query, RunSpec, Sampling } from '../api/types'

/** What the reader has chosen; number fields may be empty while they type. */
export interface BuilderForm {
  objectA: string
  /** Empty: the same object. */
  objectB: string
  question: 'cd' | 'pq'
  contacts: 'first' | 'all'
  /** Objects are solid bodies: what lies inside collides, too. */
  solid: boolean
  thoroughness: 'steps' | 'count'
  rotate: number | ''
  move: number | ''
  paper: boolean
  count: number | ''
  distance: number | ''
  passes: number | ''
  budget: number | ''
  /** Algorithms that the reader has switched off. */
  off: string[]
}

export function initialForm(): BuilderForm {
  return {
    objectA: '', objectB: '', question: 'cd', contacts: 'first', solid: false, thoroughness: 'steps', rotate: 20, move: 20, paper: false,
    count: 2000, distance: 0, passes: 3, budget: 60, off: [],
  }
}

export function queryOf({ question, contacts }: Pick<BuilderForm, 'question' | 'contacts'>): Query {
  if (question === 'pq') return 'proximity'
  return contacts === 'first' ? 'collision_first' : 'collision_all'
}

/** Why an algorithm does not fit the question; null when it does. */
export function whyUnfit(algorithm: AlgorithmInfo, query: Query, solid: boolean): string | null {
  if (algorithm.queries.includes(query)) return solid && !algorithm.solid ? 'knows surfaces only, no solid bodies' : null
  if (query === 'proximity') return 'answers no distance queries'
  return query === 'collision_all' ? 'stops at the first contact' : 'answers no collision queries'
}

export function chosenAlgorithms(form: BuilderForm, algorithms: readonly AlgorithmInfo[]): string[] {
  const query = queryOf(form)
  return algorithms.filter((a) => !whyUnfit(a, query, form.solid) && !form.off.includes(a.id)).map(({ id }) => id)
}

/** The form as the API wants it, or what is still missing, in words. Whether numbers are in range the service says. */
export function toSpec(form: BuilderForm, algorithms: readonly AlgorithmInfo[]): { spec: RunSpec } | { missing: string } {
  const { rotate, move, count, distance, passes, budget } = form
  if (!form.objectA) return { missing: 'Choose an object.' }
  const chosen = chosenAlgorithms(form, algorithms)
  if (chosen.length === 0) return { missing: 'Choose at least one algorithm that answers this question.' }
  if (distance === '') return { missing: 'Give a relative distance; 0 is the usual one.' }
  if (passes === '' || budget === '') return { missing: 'Give the number of passes and the budget.' }
  let sampling: Sampling
  if (form.thoroughness === 'count') {
    if (count === '') return { missing: 'Give the number of configurations.' }
    if (!Number.isInteger(count) || count < 0 || count > 0xffff_ffff) {
      return { missing: 'The number of configurations must be a whole number, at least 1 and at most 10,000,000.' }
    }
    sampling = { kind: 'count', count }
  } else {
    if (rotate === '' || move === '') return { missing: 'Give both steps in degrees.' }
    sampling = { kind: form.paper ? 'paper_compat' : 'steps', rotate, move }
  }
  if (!Number.isInteger(passes) || passes < 0 || passes > 0xffff_ffff) return { missing: 'The number of passes must be a whole number, 1 to 99.' }
  return {
    spec: {
      object_a: form.objectA,
      ...(form.objectB && form.objectB !== form.objectA && { object_b: form.objectB }),
      query: queryOf(form),
      ...(form.solid && { semantics: 'solid' as const }),
      method: { kind: 'sphere', sampling, seed: 0 },
      relative_distance: distance,
      algorithms: chosen,
      passes,
      budget_seconds: budget,
    },
  }
}

/** The form that would ask for a run again. */
export function fromSpec(spec: RunSpec, algorithms: readonly AlgorithmInfo[]): BuilderForm {
  const form = initialForm()
  form.objectA = spec.object_a
  form.objectB = spec.object_b ?? ''
  form.question = spec.query === 'proximity' ? 'pq' : 'cd'
  form.contacts = spec.query === 'collision_all' ? 'all' : 'first'
  form.solid = spec.semantics === 'solid'
  if (spec.method.kind === 'sphere') {
    const { sampling } = spec.method
    if (sampling.kind === 'count') Object.assign(form, { thoroughness: 'count', count: sampling.count })
    else Object.assign(form, { rotate: sampling.rotate, move: sampling.move, paper: sampling.kind === 'paper_compat' })
  }
  form.distance = spec.relative_distance ?? 0
  form.passes = spec.passes ?? form.passes
  form.budget = spec.budget_seconds ?? form.budget
  const wanted = spec.algorithms ?? []
  if (wanted.length > 0) form.off = algorithms.map(({ id }) => id).filter((id) => !wanted.includes(id))
  return form
}
