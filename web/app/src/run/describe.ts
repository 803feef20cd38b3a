import type { Method, RunInfo } from '../api/types'
import { count, significant } from '../ui/format'
import { QUERY } from '../ui/words'

/** A run in words, for headings and lists. */
export function describeRun(run: RunInfo): { title: string; query: string; placement: string } {
  const { spec, object_a_name: a, object_b_name: b } = run
  const itself = !spec.object_b || spec.object_b === spec.object_a
  const distance = spec.relative_distance ?? 0
  return {
    title: itself ? `${a} against itself` : `${a} against ${b}`,
    query: QUERY[spec.query],
    placement: `${placement(spec.method)}, distance ${distance === 0 ? '0' : significant(distance)}`,
  }
}

function placement(method: Method): string {
  if (method.kind === 'file') return 'configurations from a file'
  const { sampling } = method
  if (sampling.kind === 'count') return `sphere, ${count(sampling.count)} samples`
  const steps = `sphere, ${significant(sampling.rotate)}° / ${significant(sampling.move)}°`
  return sampling.kind === 'paper_compat' ? `${steps} as in the paper` : steps
}
