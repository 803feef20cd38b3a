import type { AlgorithmResult, RunEvent, RunInfo, Stage, State } from './types'

/** How the page hears of a run. */
export type Connection = 'live' | 'reconnecting' | 'polling'

export interface RunStreamHandlers {
  event: (event: RunEvent) => void
  connection: (state: Connection) => void
  /** Fetch the run anew: asked for at each poll. */
  poll: () => void
}

/** After so many failed connections in a row the page asks by itself instead. */
const PATIENCE = 3
const POLL_MS = 5000

const ENDED: ReadonlySet<State> = new Set(['done', 'failed', 'cancelled'])

export const hasEnded = (state: State): boolean => ENDED.has(state)

/**
 * Follows a run's events. The browser reconnects by itself and names the last event it saw (`Last-Event-ID`), so
 * nothing is lost; when that fails again and again, polling takes over while the stream keeps trying.
 */
export class RunStream {
  private readonly source: EventSource
  private failures = 0
  private timer = 0

  constructor(run: string, private readonly handlers: RunStreamHandlers) {
    this.source = new EventSource(`/api/v1/runs/${encodeURIComponent(run)}/events`)
    this.source.addEventListener('open', () => this.opened())
    this.source.addEventListener('message', (message) => this.received(message))
    this.source.addEventListener('error', () => this.failed())
  }

  close(): void {
    this.source.close()
    clearInterval(this.timer)
  }

  private opened(): void {
    this.failures = 0
    clearInterval(this.timer)
    this.timer = 0
    this.handlers.connection('live')
  }

  private received(message: MessageEvent<string>): void {
    const event = JSON.parse(message.data) as RunEvent
    this.handlers.event(event)
    if (hasEnded(event.state)) this.close()
  }

  private failed(): void {
    this.failures++
    // A closed source never comes back by itself (the answer was no event stream).
    const poll = this.failures >= PATIENCE || this.source.readyState === EventSource.CLOSED
    this.handlers.connection(poll ? 'polling' : 'reconnecting')
    if (poll && this.timer === 0) {
      this.handlers.poll()
      this.timer = window.setInterval(this.handlers.poll, POLL_MS)
    }
  }
}

/** The run after an event. */
export function applyEvent(run: RunInfo, event: RunEvent): RunInfo {
  const { stage, result } = event
  const results = result ? inOrder(run, replace(run.results, result, (a, b) => a.algorithm === b.algorithm)) : run.results
  return {
    ...run,
    state: event.state,
    runs_ahead: event.runs_ahead,
    seconds_left: event.seconds_left ?? null,
    stages: stage ? replace(run.stages, stage, sameStage) : run.stages,
    // A run that ended or waits again has nothing preliminary, as the service says when it is asked.
    results: event.state === 'running' ? results : results.filter(({ preliminary }) => !preliminary),
  }
}

/** In the order of the request, whichever was seen first. */
function inOrder({ spec }: RunInfo, results: AlgorithmResult[]): AlgorithmResult[] {
  const place = ({ algorithm }: AlgorithmResult) => (spec.algorithms ?? []).indexOf(algorithm)
  return results.toSorted((a, b) => place(a) - place(b))
}

function sameStage(a: Stage, b: Stage): boolean {
  return a.kind === b.kind && (a.algorithm ?? null) === (b.algorithm ?? null)
}

function replace<T>(list: readonly T[], item: T, same: (a: T, b: T) => boolean): T[] {
  return list.some((old) => same(old, item)) ? list.map((old) => (same(old, item) ? item : old)) : [...list, item]
}
