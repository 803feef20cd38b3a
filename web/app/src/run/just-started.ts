import type { RunInfo } from '../api/types'

let started: RunInfo | null = null

/** Keeps the answer to Start for the run's page, which then need not ask for it. */
export function keepStarted(run: RunInfo): void {
  started = run
}

/** The run as it was started, once. */
export function takeStarted(id: string): RunInfo | null {
  const run = started?.id === id ? started : null
  started = null
  return run
}
