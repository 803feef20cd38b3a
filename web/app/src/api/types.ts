export type Query = 'collision_first' | 'collision_all' | 'proximity'
export type Measure = 'time' | 'bv_tests' | 'primitive_tests' | 'density'
export type Statistic = 'mean' | 'median' | 'min' | 'max' | 'standard_deviation' | 'mad'
export type Outliers = 'keep' | 'per_vertex' | 'global'
export type Side = 'a' | 'b'
export type State = 'queued' | 'running' | 'done' | 'failed' | 'cancelled'
export type StageKind = 'object' | 'configurations' | 'measuring' | 'heatmap'
export type Class = 'clear' | 'colliding' | 'grazing'
export type Verdict = 'correct' | 'false_negative' | 'false_positive' | 'distance_over' | 'distance_under' | 'wrong_witness' | 'invalid' | 'undecidable' | 'gave_up' | 'unsupported'
export interface ObjectInfo { id: string; name: string; triangles: number; vertices: number; bounds: number[]; sha256: string; terms: string; stock: boolean; closed: boolean; warnings: string[]; created_us: number }
export interface ParameterInfo { name: string; description: string; minimum: number; maximum: number; default: number; integer: boolean }
export interface AlgorithmInfo { id: string; name: string; version: string; authors: string; license: string; url: string; paper: string; queries: Query[]; counters: boolean; witness_points: boolean; parameters: ParameterInfo[]; plugin_sha256: string }
export type Sampling = { kind: 'steps'; rotate: number; move: number } | { kind: 'paper_compat'; rotate: number; move: number } | { kind: 'count'; count: number }
export type Method = { kind: 'sphere'; sampling: Sampling; seed?: number } | { kind: 'file'; sha256: string }
export interface RunSpec { object_a: string; object_b?: string | null; query: Query; method: Method; relative_distance?: number; algorithms?: string[]; passes?: number; budget_seconds?: number }
export interface AlgorithmSeconds { algorithm: string; seconds: number; budget_limited: boolean }
export interface Estimate { configurations: number; configurations_stored: boolean; configuration_seconds: number; measuring_seconds: AlgorithmSeconds[]; total_seconds: number; runs_ahead: number; wait_seconds: number }
export interface Stage { kind: StageKind; algorithm?: string | null; state: State; done: number; total: number; rate: number; seconds_left?: number | null; message?: string | null }
export interface ClassCount { class: Class; count: number }
export interface SetInfo { sha256: string; configurations: number; missed_rays: number; longest_side: number; classes: ClassCount[]; coverage_a: number; coverage_b: number }
export interface OutcomeInfo { name: string; message: string; ours: boolean }
export interface Estimated { value: number; lo: number; hi: number }
export interface TimeSummary { mean_ns: Estimated; median_ns: Estimated; p95_ns: Estimated; max_ns: Estimated; below_resolution: number }
export interface VerdictCount { verdict: Verdict; count: number }
export interface AlgorithmResult { algorithm: string; name: string; outcome: OutcomeInfo; n: number; of: number; budget_limited: boolean; time?: TimeSummary | null; verdicts: VerdictCount[]; wrong: number; bv_tests_mean?: number | null; primitive_tests_mean?: number | null; build_ms?: number | null; memory_bytes?: number | null }
export interface Environment { cpu: string; cpus: number; memory_bytes: number; kernel: string; hardware_class: string; clock: string; null_ns: Estimated; disturbed: number; jail: string[]; version: string }
export interface RunInfo { id: string; spec: RunSpec; object_a_name: string; object_b_name: string; state: State; message?: string | null; runs_ahead: number; stages: Stage[]; results: AlgorithmResult[]; set?: SetInfo | null; environment?: Environment | null; attempts: number; mine: boolean; created_us: number; finished_us?: number | null }
export interface RunEvent { seq: number; at_us: number; state: State; runs_ahead: number; stage?: Stage | null; result?: AlgorithmResult | null }
export interface HeatmapRequest { algorithm: string; side?: Side; measure: Measure; statistic: Statistic; outliers: Outliers }
export interface Heatmap { request: HeatmapRequest; unit: string; values: (number | null)[]; counts: number[]; dropped: number[]; n: number; range?: number[] | null }
export interface Ecdf { algorithm: string; n: number; time_ns: number[]; share: number[] }
