import type { Method, RunInfo, RunSpec } from '../api/types'
import { asksSeparation, PUBLISHED_FRAMES } from '../builder/form'
import { count, significant } from '../ui/format'
import { QUERY } from '../ui/words'

/** A run in words, for headings and lists. */
export function describeRun(run: RunInfo): { title: string; query: string; placement: string } {
  const { spec, object_a_name: a, object_b_name: b } = run
  const itself = !spec.object_b || spec.object_b === spec.object_a
  return {
    title: itself ? `${a} against itself` : `${a} against ${b}`,
    query: QUERY[spec.query],
    placement: [describeMethod(spec.method), describeSeparation(spec)].filter(Boolean).join(', '),
  }
}

/** How the configurations were found. */
export function describeMethod(method: Method): string {
  if (method.kind === 'file') return 'configurations from a file'
  if (method.kind === 'trajectory') return `trajectory, ${count(method.count ?? PUBLISHED_FRAMES)} frames at ${significant(method.center_distance)} L`
  if (method.kind === 'random') return `random, ${count(method.count)} poses, ${significant(100 * method.hit_share)} % colliding`
  const { kind, sampling } = method
  if (sampling.kind === 'count') return `${kind}, ${count(sampling.count)} samples`
  const steps = `${kind}, ${significant(sampling.rotate)}° / ${significant(sampling.move)}°`
  return sampling.kind === 'paper_compat' ? `${steps} as in the paper` : steps
}

/** How far apart or how deep; nothing where the method does not ask for it. */
export function describeSeparation({ method, separation }: RunSpec): string {
  if (!asksSeparation(method.kind)) return ''
  if (separation?.kind === 'ladder') return 'ladder of steps'
  if (separation?.kind === 'step') return `step ${separation.of_size.toExponential()} of S`
  return `distance ${separation?.distance ? significant(separation.distance) : '0'}`
}
