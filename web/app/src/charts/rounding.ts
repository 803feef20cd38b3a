import type { AlgorithmResult, Rounding, SetInfo } from '../api/types'
import { count } from '../ui/format'

/** Few digits, as of an error bound. */
const about = (length: number) => length.toExponential(1).replace('e+', 'e')

/** What single precision does to an object, in words. */
export function roundingText({ moves, collapsed, flattens }: Rounding): string {
  const need = 'The coordinates of this file need double precision.'
  if (flattens) return `${need} In single precision no triangle has an area, so algorithms that compute in it cannot be measured on this object.`
  const lost = collapsed === 0 ? '' : `, and ${count(collapsed)} ${collapsed === 1 ? 'triangle loses its' : 'triangles lose their'} area`
  return `${need} Algorithms that compute in single precision get them rounded: by up to ${about(moves)}${lost}.`
}

/** Which algorithms of a run got rounded coordinates, and what rounding changes; empty where all got the same. */
export function roundingNote(results: readonly AlgorithmResult[], set: SetInfo | null | undefined): string {
  const names = results.filter(({ rounded }) => rounded).map(({ name }) => name)
  if (names.length === 0 || !set?.rounding) return ''
  const { other_answers: others, largest_change: change } = set.rounding
  const whose = names.length === 1 ? `${names[0]} computes` : `${names.slice(0, -1).join(', ')} and ${names.at(-1)} compute`
  return (
    `Single precision does not hold the coordinates of the files. ${whose} in single precision, got rounded coordinates and ${names.length === 1 ? 'is' : 'are'} ` +
    `judged by the truth about these. All other algorithms got the coordinates of the files. Rounding changes the answer to ${count(others)} of ` +
    `${count(set.configurations)} configurations, and distances by up to ${about(change)}.`
  )
}
