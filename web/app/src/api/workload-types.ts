import type { components } from './schema'
import type { State } from './types'

/** In which order the queries of a pair are put: in another order in each process, or as recorded. */
export type Track = 'shuffled' | 'recorded'

/** What an answer in a recording is worth. */
export type Claim = 'right' | 'missed_collision' | 'false_collision' | 'distance_over' | 'distance_under' | 'undecided'

/** How a recording is replayed; no algorithms stands for the usual ones, `all` for every one. */
export interface WorkloadSpec {
  algorithms?: string[]
  tracks?: Track[]
  passes?: number
  budget_seconds?: number
  seed?: number | null
}

/** What a recording says of itself. */
export interface RecordingInfo {
  file: string
  sha256: string
  bytes: number
  program: string
  libraries: string[]
  objects: number
  queries: number
  seen: number
}

/** A recording that is replayed, and how far that is. */
export interface WorkloadInfo {
  id: string
  spec: WorkloadSpec
  recording: RecordingInfo
  state: State
  /** Queries whose pair of objects is done. */
  done: number
  total: number
  runs_ahead: number
  message?: string | null
  created_us: number
  finished_us?: number | null
  result?: WorkloadResult | null
}

export interface WorkloadResult {
  program: string
  libraries: string[]
  objects: WorkloadObject[]
  seen: number
  queries: number
  left_out: { reason: string; count: number }[]
  groups: number
  hits: number
  recorded: RecordedAnswers
  tracks: TrackResult[]
  timeline: Timeline
  passes: number
  seed: number
}

export interface WorkloadObject {
  name: string
  triangles: number
  /** For a primitive: how far its triangles are from its surface at most, in the unit of the scene. */
  bound?: number | null
}

export interface RecordedAnswers {
  claims: { claim: Claim; count: number }[]
  /** In the unit of the scene. */
  largest_error: number
  /** Missed collisions first; not all of them. */
  false_answers: FalseAnswer[]
  seconds?: number | null
}

export interface FalseAnswer {
  sequence: number
  objects: number[]
  claim: Claim
  answered?: number | null
  /** The certified interval. */
  distance: number[]
}

export interface TrackResult {
  track: Track
  algorithms: AlgorithmOnWorkload[]
}

/** One algorithm in one order; times in nanoseconds. */
export interface AlgorithmOnWorkload {
  algorithm: string
  name: string
  of: number
  n: number
  total?: { ns: number; lowest_ns: number; highest_ns: number } | null
  build_ns: number
  wrong: number
  /** Part of `wrong`. */
  missed: number
  undecided: number
  silent: number
  groups?: { n: number; median_ns: number; p95_ns: number; max_ns: number; worst: number } | null
  pairs: PairTime[]
  ended: { objects: number[]; outcome: components['schemas']['OutcomeInfo'] }[]
}

export interface PairTime {
  objects: number[]
  n: number
  hits: number
  wrong: number
  ns: number
}

/** The recording in its own order, in parts of about equally many queries. */
export interface Timeline {
  from: number[]
  queries: number[]
  hits: number[]
  series: TimelineSeries[]
}

export interface TimelineSeries {
  algorithm: string
  track: Track
  n: number[]
  ns: number[]
  wrong: number[]
}

/** From the first query to the one behind the last; what is absent is an end of the recording. */
export interface Stretch {
  from?: number
  to?: number
}

export interface StretchResult {
  algorithms: AlgorithmOnStretch[]
}

export interface AlgorithmOnStretch {
  algorithm: string
  track: Track
  n: number
  ns: number
  wrong: number
  missed: number
  pairs: PairTime[]
}
