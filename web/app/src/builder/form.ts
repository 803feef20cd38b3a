import type { AlgorithmInfo, Method, ParameterInfo, Query, RunSpec, Sampling } from '../api/types'

/** What the reader has chosen; number fields may be empty while they type. */
export interface BuilderForm {
  objectA: string
  /** Empty: the same object. */
  objectB: string
  question: 'cd' | 'pq'
  contacts: 'first' | 'all'
  /** Objects are solid bodies: what lies inside collides, too. */
  solid: boolean
  method: Method['kind']
  /** Of the sphere and the grid method. */
  thoroughness: 'steps' | 'count'
  rotate: number | ''
  move: number | ''
  paper: boolean
  count: number | ''
  /** Of all methods that draw something. */
  seed: number | ''
  /** SHA-256 of the saved configurations; empty when none are chosen. */
  poses: string
  /** Of a trajectory: between the centres, in L. */
  centerDistance: number | ''
  /** Of random placement: share of poses that collide. */
  hitShare: number | ''
  separation: 'relative' | 'step' | 'ladder'
  distance: number | ''
  /** A share of the scene's size S; below 0 the objects cross. */
  step: number | ''
  passes: number | ''
  budget: number | ''
  /** Names of the algorithms, with settings behind the id where the reader wants others; null: the usual ones. */
  algorithms: string[] | null
  /** Empty: the usual one. */
  hardwareClass: string
}

/** Of a trajectory that says no number: Zachmann's run. */
export const PUBLISHED_FRAMES = 5000

export function initialForm(): BuilderForm {
  return {
    objectA: '', objectB: '', question: 'cd', contacts: 'first', solid: false, method: 'sphere', thoroughness: 'steps', rotate: 20, move: 20,
    paper: false, count: 2000, seed: 0, poses: '', centerDistance: 1, hitShare: 0.5, separation: 'relative', distance: 0, step: 0.01, passes: 5, budget: 60, algorithms: null, hardwareClass: '',
  }
}

export function queryOf({ question, contacts }: Pick<BuilderForm, 'question' | 'contacts'>): Query {
  if (question === 'pq') return 'proximity'
  return contacts === 'first' ? 'collision_first' : 'collision_all'
}

/** Why an algorithm does not fit the question; null when it does. An object may be `flat` in single precision. */
export function whyUnfit(algorithm: AlgorithmInfo, query: Query, solid: boolean, flat = false): string | null {
  if (flat && algorithm.single_precision) return 'computes in single precision, in which no triangle of the object has an area'
  if (algorithm.queries.includes(query)) return solid && !algorithm.solid ? 'supports surfaces only, no solid bodies' : null
  if (query === 'proximity') return 'answers no distance queries'
  return query === 'collision_all' ? 'stops at the first contact' : 'answers no collision queries'
}

/** The id in a name. */
export function plainId(name: string): string {
  return name.split(':', 1)[0] ?? ''
}

/** The settings in a name, in words. */
export function settingsOf(name: string): string {
  return name.split(':').slice(1).map((setting) => setting.replace('=', ' ')).join(', ')
}

/** The name of an algorithm with these values, as the API reads it; what is empty or usual is not said. */
export function nameWith(id: string, knobs: readonly ParameterInfo[], values: Readonly<Record<string, number | ''>>): string {
  const said = knobs.flatMap((knob) => {
    const value = values[knob.name]
    return value === undefined || value === '' || value === knob.default ? [] : [`${knob.name}=${value}`]
  })
  return [id, ...said].join(':')
}

/** The names that the reader has chosen, or the usual ones. */
export function wantedAlgorithms({ algorithms: wanted }: BuilderForm, algorithms: readonly AlgorithmInfo[]): string[] {
  return wanted ?? algorithms.filter(({ usual }) => usual).map(({ id }) => id)
}

/** Those of them that fit the question, by algorithm. */
export function chosenAlgorithms(form: BuilderForm, algorithms: readonly AlgorithmInfo[]): string[] {
  const query = queryOf(form)
  const wanted = wantedAlgorithms(form, algorithms)
  return algorithms.filter((a) => !whyUnfit(a, query, form.solid)).flatMap(({ id }) => wanted.filter((name) => plainId(name) === id))
}

/** Does the method look for a wanted separation? The poses of the others are given. */
export function asksSeparation(method: Method['kind']): boolean {
  return method === 'sphere' || method === 'grid'
}

/** Does it draw anything? */
export function hasSeed({ method, thoroughness, paper }: BuilderForm): boolean {
  // The paper's own pattern is the same whatever the seed.
  return method === 'random' || (asksSeparation(method) && !(thoroughness === 'steps' && paper))
}

/** What is still to be filled in, one sentence. */
type Missing = { missing: string }

function toCount({ count }: BuilderForm): number | Missing {
  if (count === '') return { missing: 'Give the number of configurations.' }
  // What does not fit the API's type would be refused in its words, not in ours.
  if (Number.isInteger(count) && count >= 0 && count <= 0xffff_ffff) return count
  return { missing: 'The number of configurations must be a whole number, at least 1 and at most 10,000,000.' }
}

function toSampling(form: BuilderForm): Sampling | Missing {
  if (form.thoroughness === 'count') {
    const count = toCount(form)
    return typeof count === 'number' ? { kind: 'count', count } : count
  }
  const { rotate, move } = form
  if (rotate === '' || move === '') return { missing: 'Give both steps in degrees.' }
  return { kind: form.paper ? 'paper_compat' : 'steps', rotate, move }
}

function toSeed(form: BuilderForm): number | Missing {
  const { seed } = form
  // A larger one would be another number by the time it is sent.
  if (seed !== '' && Number.isSafeInteger(seed) && seed >= 0) return seed
  return hasSeed(form) ? { missing: 'The seed must be a whole number, at least 0 and at most 9,007,199,254,740,991.' } : 0
}

function toMethod(form: BuilderForm): Method | Missing {
  const { method: kind, centerDistance, hitShare, poses } = form
  if (kind === 'file') return poses === '' ? { missing: 'Choose or add saved configurations.' } : { kind, sha256: poses }
  const seed = toSeed(form)
  if (typeof seed !== 'number') return seed
  if (kind === 'sphere' || kind === 'grid') {
    const sampling = toSampling(form)
    return 'missing' in sampling ? sampling : { kind, sampling, seed }
  }
  const count = toCount(form)
  if (typeof count !== 'number') return count
  if (kind === 'trajectory') {
    return centerDistance === '' ? { missing: 'Give the distance of the centres; 1 is the usual one.' } : { kind, center_distance: centerDistance, count }
  }
  return hitShare === '' ? { missing: 'Give the share of colliding poses, for example 0.5.' } : { kind, count, hit_share: hitShare, seed }
}

function toSeparation({ method, separation, distance, step }: BuilderForm): Pick<RunSpec, 'separation'> | Missing {
  if (!asksSeparation(method)) return {}
  if (separation === 'ladder') return { separation: { kind: 'ladder' } }
  if (separation === 'step') return step === '' ? { missing: 'Give a step, for example 0.01, or -0.01 for crossing objects.' } : { separation: { kind: 'step', of_size: step } }
  return distance === '' ? { missing: 'Give a relative distance; 0 is the usual one.' } : { separation: { kind: 'relative', distance } }
}

/** The form as the API wants it, or what is still missing, in words. Whether numbers are in range the service says. */
export function toSpec(form: BuilderForm, algorithms: readonly AlgorithmInfo[]): { spec: RunSpec } | Missing {
  const { passes, budget } = form
  if (!form.objectA) return { missing: 'Choose an object.' }
  const chosen = chosenAlgorithms(form, algorithms)
  if (chosen.length === 0) return { missing: 'Choose at least one algorithm that answers this query.' }
  const method = toMethod(form)
  if ('missing' in method) return method
  const separation = toSeparation(form)
  if ('missing' in separation) return separation
  if (passes === '' || budget === '') return { missing: 'Give the number of passes and the budget.' }
  if (!Number.isInteger(passes) || passes < 0 || passes > 0xffff_ffff) return { missing: 'The number of passes must be a whole number, 1 to 99.' }
  return {
    spec: {
      object_a: form.objectA,
      ...(form.objectB && form.objectB !== form.objectA && { object_b: form.objectB }),
      query: queryOf(form),
      ...(form.solid && { semantics: 'solid' as const }),
      method,
      ...separation,
      algorithms: chosen,
      passes,
      budget_seconds: budget,
      ...(form.hardwareClass && { hardware_class: form.hardwareClass }),
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
  form.hardwareClass = spec.hardware_class ?? ''
  const { method } = spec
  form.method = method.kind
  if (method.kind === 'sphere' || method.kind === 'grid') {
    const { sampling } = method
    if (sampling.kind === 'count') Object.assign(form, { thoroughness: 'count', count: sampling.count })
    else Object.assign(form, { rotate: sampling.rotate, move: sampling.move, paper: sampling.kind === 'paper_compat' })
  } else if (method.kind === 'trajectory') Object.assign(form, { centerDistance: method.center_distance, count: method.count ?? PUBLISHED_FRAMES })
  else if (method.kind === 'random') Object.assign(form, { count: method.count, hitShare: method.hit_share })
  else form.poses = method.sha256
  if ('seed' in method) form.seed = method.seed ?? 0
  const { separation } = spec
  if (separation) form.separation = separation.kind
  if (separation?.kind === 'step') form.step = separation.of_size
  if (separation?.kind === 'relative') form.distance = separation.distance
  form.passes = spec.passes ?? form.passes
  form.budget = spec.budget_seconds ?? form.budget
  // What is not installed any more cannot be asked for again.
  const wanted = (spec.algorithms ?? []).filter((name) => algorithms.some(({ id }) => id === plainId(name)))
  if (wanted.length > 0) form.algorithms = wanted
  return form
}
