import type { Accuracy, ChartKind, Class, Measure, Outliers, Query, StageKind, State, Statistic, Verdict } from '../api/types'

/** The names of the API in the words of the pages: each once. */
export const MEASURE: Record<Measure, string> = {
  time: 'Time',
  bv_tests: 'BV tests',
  primitive_tests: 'Primitive tests',
  triangle_tests: 'Tests per triangle',
  density: 'Density',
  wrong: 'Wrong answers',
  missed: 'Missed collisions',
  false_alarms: 'False alarms',
  distance_error: 'Distance error',
  flips: 'Flips',
  disagreement: 'Disagreement',
}

export const ACCURACY: Record<Accuracy, string> = {
  wrong: 'wrong answers',
  missed: 'missed collisions',
  false_alarms: 'false alarms',
  digits: 'digits (eps*)',
  distance: 'distance error',
}

/** The filters of the board. */
export const FILTER: Record<string, string> = {
  suite: 'Benchmark',
  question: 'Query',
  class: 'Contract class',
  hardware: 'Hardware class',
  scene: 'Scene (objects)',
  distance: 'Distance',
  precision: 'Precision needed',
}

export const CHART: Record<ChartKind, string> = {
  accuracy: 'Speed and accuracy',
  resolution: 'Wrong decisions',
  ecdf: 'Distribution of times',
  distance: 'By distance',
  triangles: 'By triangles',
  bv_tests: 'By BV tests',
  primitive_tests: 'By primitive tests',
}
/** What a failure is, in a sentence. */
export const FAILURE: Partial<Record<Measure, string>> = {
  wrong: 'Share of the answers that are wrong.',
  missed: 'Share of the answers that miss a collision: the worst error.',
  false_alarms: 'Share of the answers that report a collision where there is none.',
  distance_error:
    'Distance of the answer from the certified interval, in u S: unit roundoff of the algorithm’s arithmetic times the size of the scene. Up to 32 counts as right.',
  flips: 'Share of the configurations whose equivalent instances (rotated, renumbered, scaled, swapped) got contradictory answers.',
  disagreement: 'Share of the other algorithms of this run whose answer contradicts this one’s.',
}

/** Do few values at a vertex make its value doubtful? Counts are exact, and of failures one counts. */
export const isSampled = (measure: Measure): boolean => !(measure in FAILURE || measure === 'density' || measure === 'triangle_tests')

/** Failures that are shares: a mean of zeros and ones. */
export const isShare = (measure: Measure): boolean => measure in FAILURE && measure !== 'distance_error'

export const STATISTIC: Record<Statistic, string> = {
  mean: 'mean',
  median: 'median',
  min: 'minimum',
  max: 'maximum',
  standard_deviation: 'std deviation',
  mad: 'MAD',
}

export const OUTLIER: Record<Outliers, string> = { keep: 'keep', per_vertex: 'per vertex', global: 'global' }

export const QUERY: Record<Query, string> = {
  collision_first: 'Collision, first contact',
  collision_all: 'Collision, all contacts',
  proximity: 'Proximity (distance)',
}

export const STATE: Record<State, string> = {
  queued: 'waiting',
  running: 'running',
  done: 'done',
  failed: 'failed',
  cancelled: 'cancelled',
}

export const STAGE: Record<StageKind, string> = {
  object: 'Object',
  configurations: 'Configurations',
  measuring: 'Measuring',
  heatmap: 'Heatmap',
}

/** What a stage counts. */
export const STAGE_UNIT: Record<StageKind, string> = {
  object: 'objects',
  configurations: 'configurations',
  measuring: 'queries',
  heatmap: 'maps',
}

export const VERDICT: Record<Verdict, string> = {
  correct: 'correct',
  false_negative: 'missed collision',
  false_positive: 'false alarm',
  distance_over: 'distance too long',
  distance_under: 'distance too short',
  wrong_witness: 'wrong witness',
  invalid: 'invalid answer',
  undecidable: 'undecidable, not scored',
  gave_up: 'gave up',
  unsupported: 'unsupported',
}

export const CLASS: Record<Class, string> = { clear: 'clear', colliding: 'colliding', grazing: 'grazing' }
