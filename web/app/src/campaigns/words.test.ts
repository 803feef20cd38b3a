import { describe, expect, it } from 'vitest'
import type { CampaignInfo, CampaignPreview, Compared, ComparedResult } from '../api/types'
import { describePreview, describeProgress, places, ratio } from './words'

const preview: CampaignPreview = { suite_runs: 150, suite_repeats: 144, peoples_runs: 1, expected_seconds: 4500, hardware_class: 'h', oracle: 5, suite_version: 2 }

/** With ordinary spaces. */
const plain = (text: string) => text.replace(/\s/g, ' ')

describe('a campaign in words', () => {
  it('says what would be queued', () => {
    expect(plain(describePreview(preview))).toBe('This queues 150 runs of suite 2 (144 of them measured before) and 1 run of users who agreed: about 75 min of measuring.')
    expect(describePreview({ ...preview, peoples_runs: 0 })).not.toContain('users')
    expect(describePreview({ ...preview, suite_runs: 0, peoples_runs: 0 })).toContain('Nothing')
  })

  it('counts its runs', () => {
    const of = (runs: Partial<CampaignInfo['runs']>) =>
      plain(describeProgress({ runs: { waiting: 0, running: 0, done: 0, failed: 0, cancelled: 0, expected_seconds: 90, ...runs } } as CampaignInfo))
    expect(of({ waiting: 3 })).toBe('0 done, 3 waiting of 3 runs, about 2 min left')
    expect(of({ done: 1 })).toBe('1 done of 1 run')
    expect(of({ done: 2, failed: 1, running: 1, cancelled: 4 })).toBe('2 done, 1 failed, 1 running, 4 cancelled of 8 runs, about 2 min left')
  })

  it('names every machine and oracle once', () => {
    const side = (hardware_class: string, oracle: number | null) => ({ cpu: 'C', hardware_class, oracle, version: '1' }) as ComparedResult
    const rows = [{ old: side('a', 4), new: side('b', 5) }, { old: side('a', 4), new: null }, { old: side('c', null), new: null }] as Compared[]
    expect(places(rows)).toEqual({ old: 'C (a), oracle 4, version 1; C (c), oracle unknown, version 1', new: 'C (b), oracle 5, version 1' })
  })

  it('gives a ratio with its interval', () => {
    expect(ratio({ value: 0.8126, lo: 0.79, hi: 0.84 })).toEqual({ value: '0.813 ×', interval: '0.79–0.84' })
  })
})
