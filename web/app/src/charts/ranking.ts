import type { AlgorithmResult } from '../api/types'
import { count } from '../ui/format'

/** A result that may be compared, and its place. */
export interface Ranked {
  result: AlgorithmResult
  rank: number
  /** Shares its place: the intervals of the medians overlap. */
  tied: boolean
}

export interface Ranking {
  ranked: Ranked[]
  /** Listed with the reason, never with a place. */
  unranked: { result: AlgorithmResult; reason: string }[]
}

/**
 * Places by median time. Only an algorithm that ended well, answered everything, nothing of it wrong, and has a time gets a
 * place; those whose interval overlaps that of the best of their group share it.
 */
export function rank(results: readonly AlgorithmResult[]): Ranking {
  const unranked = results.flatMap((result) => {
    const reason = whyNot(result)
    return reason ? [{ result, reason }] : []
  })
  const sound = results.filter((result) => !whyNot(result)).toSorted((a, b) => median(a).value - median(b).value)
  const groups: AlgorithmResult[][] = []
  for (const result of sound) {
    const group = groups.at(-1)
    const best = group?.[0]
    if (group && best && median(result).lo <= median(best).hi) group.push(result)
    else groups.push([result])
  }
  let place = 1
  const ranked = groups.flatMap((group) => {
    const at = place
    place += group.length
    return group.map((result) => ({ result, rank: at, tied: group.length > 1 }))
  })
  return { ranked, unranked }
}

function median(result: AlgorithmResult): { value: number; lo: number; hi: number } {
  const nothing = { value: Number.POSITIVE_INFINITY, lo: Number.POSITIVE_INFINITY, hi: Number.POSITIVE_INFINITY }
  return result.time?.median_ns ?? nothing
}

/** Questions to which it gave up or said that it does not answer them. */
function unanswered(result: AlgorithmResult): number {
  return result.verdicts.reduce((sum, { verdict, count: n }) => sum + (verdict === 'gave_up' || verdict === 'unsupported' ? n : 0), 0)
}

function whyNot(result: AlgorithmResult): string | null {
  if (result.outcome.name !== 'Completed') return result.outcome.message
  if (result.wrong > 0) return 'It gave wrong answers: a time for a wrong answer is no result.'
  if (!result.time) return 'Nothing was measured.'
  const silent = unanswered(result)
  if (silent > 0) return `It gave no answer to ${count(silent)} of ${count(result.n)}: giving up is not wrong, but it is not as fast as it looks.`
  return null
}
