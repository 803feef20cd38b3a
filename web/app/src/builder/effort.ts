import type { RunSpec } from '../api/types'

/** How much of a run is measured: a quick look, until the algorithms are told apart, or everything. */
export type Effort = 'quick' | 'settled' | 'whole'

/** Configurations of a quick look. */
export const QUICK = 5000
/** Differences below this share do not matter. */
export const PRECISION = 0.05

/** The run with this effort. */
export function withEffort(whole: RunSpec, effort: Effort): RunSpec {
  if (effort === 'quick') return { ...whole, at_most: QUICK }
  return effort === 'settled' ? { ...whole, precision: PRECISION } : whole
}

/** The effort of a run that was asked for. */
export function effortOf(spec: RunSpec): Effort {
  if (spec.at_most != null) return 'quick'
  return spec.precision != null ? 'settled' : 'whole'
}

/** Why a part cannot be measured, in words; null when it can. */
export function whyNot(effort: Effort, spec: RunSpec): string | null {
  if (effort === 'whole') return null
  if (spec.method.kind === 'trajectory') return 'A trajectory is always measured as a whole, because the order of its queries matters.'
  if (effort === 'quick') return null
  if ((spec.algorithms ?? []).length < 2) return 'There is nothing to compare: choose at least two algorithms.'
  return (spec.passes ?? 0) < 3 ? 'The precision of a comparison can be measured only with several passes: choose at least 3.' : null
}

/** Is there anything to save? Nobody knows before the first estimate. */
export const isLarge = (configurations: number | undefined): boolean => configurations !== undefined && configurations > QUICK

/** Wrong answers so rare are seen at least once with 95 %: the rule of three. */
export const rarest = (configurations: number): number => Math.max(1, Math.floor(configurations / 3))
