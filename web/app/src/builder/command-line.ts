import type { RunSpec } from '../api/types'
import { PUBLISHED_FRAMES } from './form'

/** The same run on the command line. `file` gives the file of an uploaded object, whose id only the service knows. */
export function commandLine(spec: RunSpec, file: (id: string) => string): string {
  const objects = [spec.object_a, ...(spec.object_b && spec.object_b !== spec.object_a ? [spec.object_b] : [])]
  const lines = [
    `ocb bench ${objects.map((id) => quote(file(id))).join(' ')}`,
    `--query ${spec.query === 'proximity' ? 'pq' : 'cd'}${spec.query === 'collision_all' ? ' --contacts all' : ''}${spec.semantics === 'solid' ? ' --solid' : ''}`,
    placement(spec),
    ...(spec.algorithms ?? []).map((algorithm) => `--algorithm ${quote(algorithm)}`),
    ...(spec.passes === undefined ? [] : [`--passes ${spec.passes}`]),
    ...(spec.budget_seconds === undefined ? [] : [`--budget ${spec.budget_seconds}`]),
    ...(spec.at_most == null ? [] : ['--quick']),
    ...(spec.precision == null ? [] : [`--precision ${100 * spec.precision}%`]),
  ]
  return lines.join(' \\\n  ')
}

function placement({ method, separation }: RunSpec): string {
  if (method.kind === 'file') return '--configurations configurations.parquet'
  if (method.kind === 'trajectory') return `--method trajectory --center-distance ${method.center_distance} --count ${method.count ?? PUBLISHED_FRAMES}`
  const seed = method.seed ? ` --seed ${method.seed}` : ''
  if (method.kind === 'random') return `--method random --count ${method.count} --hit-share ${method.hit_share}${seed}`
  const { sampling } = method
  const how =
    sampling.kind === 'count'
      ? `--count ${sampling.count}`
      : `--rotate ${sampling.rotate} --move ${sampling.move}${sampling.kind === 'paper_compat' ? ' --paper-compat' : ''}`
  return `--method ${method.kind} ${how}${seed} ${apart(separation)}`
}

function apart(separation: RunSpec['separation']): string {
  if (separation?.kind === 'ladder') return '--ladder'
  return separation?.kind === 'step' ? `--step=${separation.of_size}` : `--distance ${separation?.distance ?? 0}`
}

/** A word that a POSIX shell takes as it is. */
export function quote(word: string): string {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", String.raw`'\''`)}'`
}
