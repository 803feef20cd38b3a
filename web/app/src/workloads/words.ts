import type { AlgorithmOnWorkload, RecordedAnswers, RecordedClaim as Claim, Track, WorkloadInfo, WorkloadResult } from '../api/types'
import { count, percent, significant, time } from '../ui/format'
import { isFair, type Standing, together } from './fastest'

/** What an answer is worth, the worst first. */
export const CLAIM: Record<Claim, string> = {
  missed_collision: 'missed collision',
  false_collision: 'collision that is none',
  distance_over: 'distance too large',
  distance_under: 'distance too small',
  undecided: 'cannot be decided',
  right: 'right',
}
const CLAIMS = Object.keys(CLAIM) as Claim[]

export const isFalse = (claim: Claim): boolean => claim !== 'right' && claim !== 'undecided'

export const ORDER: Record<Track, string> = { shuffled: 'Shuffled', recorded: 'As recorded', scene: 'Whole scene' }

/** How the queries of an order are put. */
export const ASKED: Record<Track, string> = {
  shuffled: 'Pair by pair, in another order in each process.',
  recorded: 'Pair by pair, as recorded.',
  scene: 'All queries as recorded, to one process that has loaded every object once. Only algorithms that offer ocb.scene/1 are asked so. Not comparable with the other orders, where a process holds two objects.',
}

export const isOpen = ({ state }: Pick<WorkloadInfo, 'state'>): boolean => state === 'queued' || state === 'running'

/** A scene about which nothing was asked. */
export const isScene = ({ recording }: Pick<WorkloadInfo, 'recording'>): boolean => recording.queries === 0

/** The recorded program, or the recording's file where it does not say. */
export const titleOf = ({ recording }: Pick<WorkloadInfo, 'recording'>): string => recording.program || recording.file

/** How far a replay is, in a sentence. */
export function progressWords({ state, runs_ahead: ahead, done, total }: Pick<WorkloadInfo, 'state' | 'runs_ahead' | 'done' | 'total'>): string {
  if (state === 'queued') return ahead === 0 ? 'Next replay in the queue.' : `${ahead} ${ahead === 1 ? 'replay' : 'replays'} ahead in the queue.`
  if (total === 0) return 'A scene without queries: there is nothing to replay.'
  return `${count(done)} of ${count(total)} queries replayed.`
}

/** The claims that occur, the worst first. */
export function claims({ claims: all }: RecordedAnswers): RecordedAnswers['claims'] {
  return all.toSorted((a, b) => CLAIMS.indexOf(a.claim) - CLAIMS.indexOf(b.claim))
}

/** What the program's own answers are worth, in a sentence. */
export function recordedWords({ claims: all }: RecordedAnswers): string {
  const sum = (of: (claim: Claim) => boolean) => all.filter(({ claim }) => of(claim)).reduce((n, { count: more }) => n + more, 0)
  const [answers, wrong, undecided] = [sum(() => true), sum(isFalse), sum((claim) => claim === 'undecided')]
  if (answers === 0) return 'The recording holds no answers of the program, so there is nothing to judge.'
  const open = undecided === 0 ? '' : ` ${count(undecided)} cannot be decided.`
  if (wrong === 0) return `None of the ${count(answers)} answers that the program got is false.${open}`
  return `${count(wrong)} of the ${count(answers)} answers that the program got ${wrong === 1 ? 'is' : 'are'} false.${open}`
}

export const objectName = ({ objects }: Pick<WorkloadResult, 'objects'>, place: number): string => objects[place]?.name ?? `object ${place}`

export const pairName = (result: Pick<WorkloadResult, 'objects'>, [a = 0, b = 0]: readonly number[]): string =>
  `${objectName(result, a)} against ${objectName(result, b)}`

/** The fastest algorithm and how it compares with the next, in a sentence. */
export function standingWords(found: Standing | null): string {
  if (!found) return 'No algorithm answered all its queries without a wrong answer, so none is called the fastest.'
  const { fastest, next, tied } = found
  const n = count(fastest.n)
  if (!next) return `${fastest.name} is the only algorithm that answered all ${n} queries without a wrong answer.`
  if (tied.length > 0) {
    const names = [fastest, ...tied].map(({ name }) => name)
    return `${names.slice(0, -1).join(', ')} and ${names.at(-1)} are the fastest and cannot be told apart; none of them gave a wrong answer to ${n} queries.`
  }
  return `${fastest.name} answers these queries fastest, ${significant(next.ratio)} times as fast as ${next.one.name}, with no wrong answer to ${n} queries.`
}

/** Where the fastest spends most of its time, in a sentence. */
export function dearestWords(result: WorkloadResult, { fastest }: Standing): string | null {
  const [pair] = fastest.pairs
  const all = together(fastest)
  if (!pair || !(all > 0)) return null
  return `${fastest.name} spends ${percent(pair.ns / all)} of its time on one pair, ${pairName(result, pair.objects)}, with ${percent(pair.n / fastest.n)} of the queries.`
}

/** Why the time of an algorithm is not compared; null where it is. `most`: queries of those that are compared. */
export function whyApart(one: AlgorithmOnWorkload, most: number): string | null {
  if (isFair(one)) return one.n < most ? `Answers ${count(one.of)} of the ${count(most)} queries only: not of every kind.` : null
  if (one.wrong > 0) return 'Gave wrong answers, so its time is not compared.'
  if (one.silent > 0) return `Gave no answer to ${count(one.silent)} queries.`
  if (one.ended.length > 0) return null
  return one.n === 0 ? 'Was not asked anything.' : 'Was not asked everything within its budget.'
}

/** How it ended. */
export function outcomeWords({ n, of, ended }: AlgorithmOnWorkload): string {
  const [first] = ended
  if (first && !first.objects) return `${first.outcome.name} on the whole scene`
  if (first) return `${first.outcome.name} on ${count(ended.length)} ${ended.length === 1 ? 'pair' : 'pairs'}`
  return n < of ? 'Budget used up' : 'Completed'
}

/** What was replayed, in a sentence or two. */
export function scopeWords({ queries, seen, groups, objects, hits, passes, tracks }: WorkloadResult): string {
  const solids = objects.filter(({ bound }) => bound != null).length
  const primitives = solids === 0 ? '' : `, ${count(solids)} of them primitives`
  return `${count(queries)} of ${count(seen)} queries in ${count(groups)} groups about ${count(objects.length)} objects${primitives}; ${percent(queries > 0 ? hits / queries : 0)} collide. ${count(passes)} ${passes === 1 ? 'process' : 'processes'} per algorithm, order and pair${tracks.some(({ track }) => track === 'scene') ? '; for the whole scene, per algorithm' : ''}.`
}

/** How long the program's own library took, where that was recorded. */
export function libraryWords({ seconds: took }: RecordedAnswers, libraries: readonly string[]): string | null {
  if (took == null) return null
  return `In the recorded program ${libraries.length > 0 ? libraries.join(', ') : 'its library'} took ${time(1e9 * took)}, as recorded on that machine; this is not comparable with the times here.`
}
