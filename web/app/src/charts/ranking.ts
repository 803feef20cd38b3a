import type { AlgorithmResult, ContractClass } from '../api/types'
import { count } from '../ui/format'
import { onlyElsewhere } from './units'

/** A result that may be compared, and its place. */
export interface Ranked {
  result: AlgorithmResult
  rank: number
  /** Shares its place: the intervals of the ratios to the reference overlap. */
  tied: boolean
}

/** Results that are compared with one another, and with no others. */
export interface Ranking {
  /** What they had to deliver, in words; empty in runs of older versions. */
  words: string
  ranked: Ranked[]
  /** Listed with the reason, never with a place. */
  unranked: { result: AlgorithmResult; reason: string }[]
}

/** A contract class in words. */
export function classWords({ delivered, order, cpus, bits }: ContractClass): string {
  return [DELIVERED[delivered], order, `${cpus} CPU${cpus === 1 ? '' : 's'}`, `f${bits}`].join(', ')
}

const DELIVERED: Record<ContractClass['delivered'], string> = {
  first_contact: 'first contact', all_contacts: 'all contacts', distance: 'distance', distance_with_witness: 'distance with witness',
}

/** One ranking per contract class, in the order in which the classes first occur. */
export function rankings(results: readonly AlgorithmResult[]): Ranking[] {
  const words = (result: AlgorithmResult) => (result.class ? classWords(result.class) : '')
  const classes = [...new Set(results.map(words))]
  return classes.map((of) => ({ words: of, ...rank(results.filter((result) => words(result) === of)) }))
}

/**
 * The places that the service gave. Only an algorithm that ended well, answered everything, nothing of it wrong, and was
 * compared with the reference gets one.
 */
export function rank(results: readonly AlgorithmResult[]): Omit<Ranking, 'words'> {
  const soFar = ({ place_so_far: place }: AlgorithmResult) => place ?? Number.MAX_VALUE
  const unranked = results
    .flatMap((result) => {
      const reason = whyNot(result)
      return reason ? [{ result, reason }] : []
    })
    .toSorted((a, b) => soFar(a.result) - soFar(b.result))
  const placed = results.flatMap((result) => (result.rank == null || whyNot(result) ? [] : [{ result, rank: result.rank }]))
  const ranked = placed
    .toSorted((a, b) => a.rank - b.rank || (a.result.ratio?.value ?? 0) - (b.result.ratio?.value ?? 0))
    .map((one) => ({ ...one, tied: placed.filter((other) => other.rank === one.rank).length > 1 }))
  return { ranked, unranked }
}

/** Questions to which it gave up or said that it does not answer them. */
function unanswered(result: AlgorithmResult): number {
  return result.verdicts.reduce((sum, { verdict, count: n }) => sum + (verdict === 'gave_up' || verdict === 'unsupported' ? n : 0), 0)
}

function whyNot(result: AlgorithmResult): string | null {
  if (result.preliminary) return 'Still being measured.'
  if (result.outcome.name !== 'Completed') return result.outcome.message
  if (result.unranked) return result.unranked.message
  if (onlyElsewhere(result)) return 'It gave wrong answers in another unit of length, and none in the unit of the files.'
  if (result.wrong > 0) return 'It gave wrong answers, so its time is not ranked.'
  if (!result.time) return 'Nothing was measured.'
  const silent = unanswered(result)
  if (silent > 0) return `It did not answer ${count(silent)} of ${count(result.n)} queries, so its time is not ranked.`
  if (result.rank == null) return 'It was not compared with a reference: it was measured in the development profile, or by an older version.'
  return null
}
