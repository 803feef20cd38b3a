import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest'
import { applyEvent, RunStream, type Connection } from './run-stream'
import type { AlgorithmResult, RunEvent, RunInfo, Stage } from './types'

const stage = (kind: Stage['kind'], algorithm: string | null, state: Stage['state'], done: number): Stage => ({
  kind, algorithm, state, done, total: 10, rate: 1, seconds_left: null, message: null,
})
const event = (more: Partial<RunEvent>): RunEvent => ({ seq: 1, at_us: 0, state: 'running', runs_ahead: 0, stage: null, result: null, ...more })
const run = {
  state: 'queued', runs_ahead: 2, results: [],
  stages: [stage('object', null, 'queued', 0), stage('measuring', 'a', 'queued', 0), stage('measuring', 'b', 'queued', 0)],
} as unknown as RunInfo

describe('applyEvent', () => {
  it('changes only the stage of its algorithm', () => {
    const after = applyEvent(run, event({ stage: stage('measuring', 'b', 'running', 4) }))
    expect(after.stages.map((s) => s.done)).toEqual([0, 0, 4])
    expect([after.state, after.runs_ahead]).toEqual(['running', 0])
    expect(run.stages[2]?.done).toBe(0)
  })

  it('keeps the newest numbers of each algorithm, in the order of the request', () => {
    const result = (algorithm: string, n: number, preliminary: boolean) => ({ algorithm, n, preliminary }) as AlgorithmResult
    const asked = { ...run, spec: { algorithms: ['a', 'b'] } } as RunInfo
    const all = [result('b', 300, true), result('a', 200, true), result('b', 5000, false)]
    const after = all.reduce((before, one) => applyEvent(before, event({ result: one, seconds_left: one.n / 100 })), asked)
    expect(after.results.map(({ algorithm, n }) => [algorithm, n])).toEqual([['a', 200], ['b', 5000]])
    expect(after.seconds_left).toBe(50)
    const cancelled = applyEvent(after, event({ state: 'cancelled' }))
    expect(cancelled.results.map(({ algorithm }) => algorithm)).toEqual(['b'])
  })
})

class FakeSource extends EventTarget {
  static readonly CLOSED = 2
  static last: FakeSource
  readyState = 0
  constructor(readonly url: string) {
    super()
    FakeSource.last = this
  }
  close() {
    this.readyState = FakeSource.CLOSED
  }
  say(name: string, data?: RunEvent) {
    this.dispatchEvent(data ? new MessageEvent(name, { data: JSON.stringify(data) }) : new Event(name))
  }
}

describe('RunStream', () => {
  beforeEach(() => {
    vi.useFakeTimers()
    vi.stubGlobal('EventSource', FakeSource)
  })
  afterEach(() => {
    vi.useRealTimers()
    vi.unstubAllGlobals()
  })

  function open() {
    const seen = { events: [] as number[], states: [] as Connection[], polls: 0 }
    const stream = new RunStream('r 1', {
      event: (e) => seen.events.push(e.seq), connection: (s) => seen.states.push(s), poll: () => seen.polls++,
    })
    return { stream, seen, source: FakeSource.last }
  }

  it('hands on events and closes after the last one', () => {
    const { seen, source } = open()
    expect(source.url).toBe('/api/v1/runs/r%201/events')
    source.say('message', event({ seq: 7 }))
    source.say('message', event({ seq: 8, state: 'done' }))
    expect(seen.events).toEqual([7, 8])
    expect(source.readyState).toBe(FakeSource.CLOSED)
  })

  it('polls after three failures in a row, and stops when the stream is back', () => {
    const { seen, source } = open()
    source.say('error')
    source.say('error')
    expect([seen.states.at(-1), seen.polls]).toEqual(['reconnecting', 0])
    source.say('error')
    vi.advanceTimersByTime(10_000)
    expect([seen.states.at(-1), seen.polls]).toEqual(['polling', 3])
    source.say('open')
    vi.advanceTimersByTime(60_000)
    expect([seen.states.at(-1), seen.polls]).toEqual(['live', 3])
  })

  it('polls at once when the browser has given up', () => {
    const { stream, seen, source } = open()
    source.close()
    source.say('error')
    expect(seen.polls).toBe(1)
    stream.close()
    vi.advanceTimersByTime(60_000)
    expect(seen.polls).toBe(1)
  })
})
