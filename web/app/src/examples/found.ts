import { headline, interval, ofSide, shareText } from '../advisor/words'
import type { Advice, AlgorithmResult } from '../api/types'
import { count, estimated, significant } from '../ui/format'

/** What a finished run found, in sentences: who is fastest among the right ones, and who is wrong. */
export function found(results: readonly AlgorithmResult[]): string[] {
  const right = results
    .flatMap(({ name, rank, time, n }) => (rank !== null && rank !== undefined && time ? [{ name, n, median: time.median_ns }] : []))
    .toSorted((a, b) => a.median.value - b.median.value)
  const sentences: string[] = []
  const [first] = right
  const last = right.at(-1)
  if (first) {
    const { value, interval: between } = estimated(first.median)
    const more = last && last !== first ? `, ${last.name} ${significant(last.median.value / first.median.value, 2)}× as long` : ''
    sentences.push(`${first.name} takes ${value} at the median (${between}, n = ${count(first.n)})${more}.`)
  }
  for (const { name, wrong, n, time } of results) {
    const takes = time ? ` takes ${estimated(time.median_ns).value} (${estimated(time.median_ns).interval}) and` : ''
    if (wrong > 0) sentences.push(`${name}${takes} is wrong in ${count(wrong)} of ${count(n)} configurations.`)
  }
  return sentences
}

/** What less detail saves and costs, in sentences. */
export function savedBy(advice: Advice): string[] {
  const { held_out: held } = advice
  const sentences = [headline(advice)]
  if (advice.stages.length > 0) sentences.push(`${interval(advice.faster)} times faster than the whole objects (n = ${count(advice.configurations)}).`)
  const error = advice.question.kind === 'distance' ? `The largest error was ${ofSide(advice, held.observed_error)} of the longest side; ` : ''
  sentences.push(`${error}${error ? 'wrong' : 'Wrong'} answers on other configurations: ${shareText(held.wrong)}.`)
  return sentences
}
