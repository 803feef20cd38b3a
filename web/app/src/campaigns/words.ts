import type { CampaignInfo, CampaignPreview, Compared, Estimated } from '../api/types'
import { count, seconds, significant } from '../ui/format'

const runs = (n: number) => `${count(n)} ${n === 1 ? 'run' : 'runs'}`

/** What the button would queue, in a sentence. */
export function describePreview(preview: CampaignPreview): string {
  const { suite_runs: suite, suite_repeats: repeats, peoples_runs: people } = preview
  if (suite + people === 0) return 'Nothing to measure again: all results are from this hardware class and this oracle, or are already queued.'
  const parts = [
    suite > 0 && `${runs(suite)} of suite ${preview.suite_version} (${count(repeats)} of them measured before)`,
    people > 0 && `${runs(people)} of users who agreed`,
  ]
  return `This queues ${parts.filter(Boolean).join(' and ')}: about ${seconds(preview.expected_seconds)} of measuring.`
}

/** How far a campaign is. */
export function describeProgress({ runs: { waiting, running, done, failed, cancelled, expected_seconds: expected } }: CampaignInfo): string {
  const parts: [number, string][] = [[done, 'done'], [failed, 'failed'], [running, 'running'], [waiting, 'waiting'], [cancelled, 'cancelled']]
  const told = parts.filter(([n], i) => n > 0 || i === 0).map(([n, word]) => `${count(n)} ${word}`)
  const left = waiting + running > 0 ? `, about ${seconds(expected)} left` : ''
  return `${told.join(', ')} of ${runs(waiting + running + done + failed + cancelled)}${left}`
}

/** Of which two places the results are; an empty text where there is none yet. */
export function places(results: readonly Compared[]): { old: string; new: string } {
  const of = (side: 'old' | 'new') => {
    const all = results.flatMap((row) => row[side] ?? []).map((one) => `${one.cpu} (${one.hardware_class}), oracle ${one.oracle ?? 'unknown'}, version ${one.version}`)
    return [...new Set(all)].join('; ')
  }
  return { old: of('old'), new: of('new') }
}

/** New divided by old: `0.813 ×`, `0.79–0.84`. */
export function ratio(estimate: Estimated): { value: string; interval: string } {
  return { value: `${significant(estimate.value)} ×`, interval: `${significant(estimate.lo)}–${significant(estimate.hi)}` }
}
