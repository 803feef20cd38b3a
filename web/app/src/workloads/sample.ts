import type { AlgorithmOnWorkload, PairTime, WorkloadResult } from '../api/types'

/** One algorithm of a small replay, for tests: 100 queries about two pairs, all answered right. */
export function algorithm(id: string, ns: number, change: Partial<AlgorithmOnWorkload> = {}): AlgorithmOnWorkload {
  return {
    algorithm: id, name: id.toUpperCase(), of: 100, n: 100, total: { ns, lowest_ns: 0.9 * ns, highest_ns: 1.1 * ns }, build_ns: 1e6, wrong: 0, missed: 0,
    undecided: 0, silent: 0, groups: { n: 10, median_ns: ns / 10, p95_ns: ns / 5, max_ns: ns / 4, worst: 3 },
    pairs: [pair([0, 1], 0.75 * ns, 60), pair([0, 2], 0.25 * ns, 40)], ended: [], ...change,
  }
}

/** A pair of a replay of which a half collides, for tests. */
export const pair = (objects: number[], ns: number, n = 10): PairTime => ({ objects, n, hits: n / 2, wrong: 0, ns })

/** A small replay, for tests: three objects, four parts of 25 queries, of which numbers 25 to 49 are missing. */
export function replay(change: Partial<WorkloadResult> = {}): WorkloadResult {
  const ids = ['fast', 'slow']
  return {
    program: 'planner', libraries: ['fcl 0.7'], seen: 125, queries: 100, groups: 10, hits: 50, left_out: [{ reason: 'their pose is no rotation', count: 25 }],
    objects: [{ name: 'arm', triangles: 900, bound: null }, { name: 'table', triangles: 12, bound: null }, { name: 'ball', triangles: 320, bound: 0.001 }],
    recorded: { claims: [{ claim: 'right', count: 100 }], largest_error: 0, false_answers: [], seconds: null },
    tracks: [
      { track: 'shuffled', algorithms: [algorithm('fast', 1000), algorithm('slow', 3000)] },
      { track: 'recorded', algorithms: [algorithm('fast', 500), algorithm('slow', 2900)] },
    ],
    timeline: {
      from: [0, 50, 75, 100], queries: [25, 25, 25, 25], hits: [25, 0, 5, 20],
      series: ids.map((id, i) => ({ algorithm: id, track: 'shuffled', n: [25, 25, 0, 25], ns: [250, 500, 0, 250].map((ns) => (i + 1) * ns), wrong: [0, 0, 0, i] })),
    },
    passes: 3, seed: 7, ...change,
  }
}
