import { quote } from '../builder/command-line'
import type { Advice, AdviceInfo, AdvicePoint, AdviceSpec, Share } from '../api/types'
import { count, percent, significant } from '../ui/format'

/** `3.42 [3.10, 3.80]`: a number and its 95 % interval. */
export const interval = ({ value, lo, hi }: { value: number; lo: number; hi: number }): string =>
  `${significant(value)} [${significant(lo)}, ${significant(hi)}]`

/** A share as it was seen; of nothing seen, what it is below with 95 % confidence. */
export function shareText(share: Share | null | undefined): string {
  if (!share || share.of === 0) return '–'
  if (share.seen === 0) return `0 of ${count(share.of)} (< ${percent(share.hi)})`
  return `${count(share.seen)} of ${count(share.of)} (${percent(share.seen / share.of)})`
}

/** A length as a share of the first object's longest side. */
export const ofSide = (advice: Advice, length: number | null | undefined): string =>
  length === null || length === undefined ? '–' : percent(length / advice.longest_side)

/** Triangles of both objects, stage by stage. */
export function stagesText(advice: Advice, stages: readonly (readonly number[])[]): string {
  const of = ([a = 0, b = 0]: readonly number[]) =>
    `${count(advice.levels_a[a]?.triangles ?? 0)} + ${count(advice.levels_b[b]?.triangles ?? 0)}`
  return stages.map(of).join(', then ')
}

/** What a way asks, in words. */
export function pointName(advice: Advice, point: AdvicePoint): string {
  const asked = point.asked == null ? '' : `${count(point.asked)} of ${count(advice.configurations)} queried`
  const remarks = [point.certified ? '' : 'uncertified', asked].filter(Boolean).join('; ')
  return remarks ? `${bareName(advice, point)} (${remarks})` : bareName(advice, point)
}

function bareName(advice: Advice, point: AdvicePoint): string {
  switch (point.kind) {
    case 'whole': return 'Whole objects, distance'
    case 'same_question': return 'Whole objects, only this query'
    case 'yes_no': return 'Whole objects, yes or no instead of a distance'
    case 'levels': return `Levels ${stagesText(advice, point.stages)}`
    case 'advised': return 'Advised'
    case 'hulls': return 'Convex hulls'
    case 'boxes': return 'Boxes'
    case 'convex_parts': return `Convex parts, ${point.algorithm}`
    case 'inner_spheres': return `Inner spheres, ${point.algorithm}`
    case 'voxels': return `Voxels${advice.question.kind === 'distance' ? ', yes or no' : ''}, ${point.algorithm}`
    case 'double_precision': return `Whole objects in f64, ${point.algorithm}`
    case 'single_precision': return `Whole objects in f32, ${point.algorithm}`
  }
}

/** How large its model is, and in what that is counted. */
export const sizeText = ({ elements, unit }: AdvicePoint): string => `${count(elements)} ${unit}`

/** The setting of a method's knob, or its precision: what stands beside its mark. */
export function settingText({ kind, algorithm }: AdvicePoint): string {
  if (kind === 'single_precision') return 'f32'
  if (kind === 'double_precision') return 'f64'
  return algorithm?.split(':')[1] ?? ''
}

/** The advice in one sentence. */
export function headline(advice: Advice): string {
  const { stages, triangles_before: before, triangles_after: after } = advice
  if (stages.length === 0) return `The whole objects, ${count(before)} triangles, are the fastest: less detail saves nothing here.`
  return `Sufficient: ${stagesText(advice, stages)} instead of ${count(before)} triangles, ${significant(before / after)} times fewer.`
}

/** The work has not ended. */
export const open = ({ state }: AdviceInfo): boolean => state === 'queued' || state === 'running'

/** What was asked, in a sentence. */
export function questionText({ spec, names: [a, b] }: AdviceInfo): string {
  const pair = spec.object_b && spec.object_b !== spec.object_a ? `${a} against ${b}` : `${a} against itself`
  const { question } = spec
  return question.kind === 'distance'
    ? `${pair}: how far apart, within ${percent(question.tolerance)} of A’s longest side?`
    : `${pair}: further apart than ${percent(question.clearance)} of A’s longest side?`
}

/** The same question on the command line; `file` is what the command names for an object. */
export function commandLine({ object_a: a, object_b: b, question }: AdviceSpec, file: (id: string) => string): string {
  const share = (part: number) => `${Number((100 * part).toPrecision(12))}%`
  const asked = question.kind === 'distance' ? `--tolerance ${share(question.tolerance)}` : `--question clearance=${share(question.clearance)}`
  return `ocb advise ${[a, ...(b && b !== a ? [b] : [])].map((id) => quote(file(id))).join(' ')} ${asked}`
}
