import { useQueries, useQueryClient } from '@tanstack/vue-query'
import { computed, markRaw, watch, type ComputedRef } from 'vue'
import { getEcdf, getHeatmap } from '../api/client'
import type { AlgorithmResult, Ecdf, Heatmap, HeatmapRequest, RunInfo } from '../api/types'
import { count } from '../ui/format'
import { steadyList } from '../ui/steady'
import { differs, MAX_PANES, type ExplorerState } from './url-state'

/** One picture: whose values, and the map when it is there. */
export interface PaneData {
  algorithm: string
  title: string
  heatmap: Heatmap | null
  error: string | null
  /** Place among the measured algorithms, as in the chart; null for what belongs to all. */
  series: number | null
}

/** Algorithms with values to show: measured on at least one configuration. */
export function measured(run: RunInfo): { id: string; name: string }[] {
  return run.results.filter((result) => result.n > 0).map(({ algorithm, name }) => ({ id: algorithm, name }))
}

/** The run is still being measured, and there is something to show of it. */
export function isPreliminary(run: RunInfo): boolean {
  return run.results.some(({ preliminary, n }) => preliminary && n > 0)
}

/** Number of answers behind preliminary results: `300`, or `300 to 5,000` where algorithms differ. */
export function preliminaryN(run: RunInfo): string {
  const all = run.results.filter(({ n }) => n > 0).map(({ n }) => n)
  const [least, most] = [Math.min(...all), Math.max(...all)]
  return least === most ? count(most) : `${count(least)} to ${count(most)}`
}

/** Fastest first; what has no time comes last. */
function byTime(run: RunInfo): { id: string; name: string }[] {
  const median = new Map(run.results.map(({ algorithm, time }) => [algorithm, time?.median_ns.value ?? Number.MAX_VALUE]))
  return measured(run).toSorted((a, b) => (median.get(a.id) ?? 0) - (median.get(b.id) ?? 0))
}

/** The algorithms on the screen: all on the wall, else those of the link that exist, else the first four. */
export function visibleAlgorithms(run: RunInfo, state: ExplorerState): { id: string; name: string }[] {
  const all = measured(run)
  const chosen = all.filter(({ id }) => state.algorithms.includes(id))
  const shown = state.wall && !state.points ? byTime(run) : (chosen.length > 0 ? chosen : all).slice(0, MAX_PANES)
  // Density counts configurations, and closest points are theirs: the same for every algorithm.
  if (state.measure === 'density' || state.points) return shown.slice(0, 1)
  // Nothing differs from itself.
  const others = shown.filter(({ id }) => state.againstRun !== '' || id !== state.against)
  return others.length > 0 ? others : all.filter(({ id }) => id !== state.against).slice(0, 1)
}

/** What is subtracted, behind the name of a picture. */
function minus(run: RunInfo, state: ExplorerState): string {
  if (!differs(state)) return ''
  const other = run.results.find(({ algorithm }) => algorithm === state.against)?.name ?? state.against
  return ` − ${[other, state.againstRun && 'the other run'].filter(Boolean).join(', ')}`
}

/** The request behind one picture. */
export function heatmapRequest(state: ExplorerState, algorithm: string): HeatmapRequest {
  const { side, measure, statistic, outliers, against, againstRun } = state
  return {
    algorithm, side, measure, statistic, outliers,
    ...(differs(state) && against && { against }),
    ...(againstRun && { against_run: againstRun }),
  }
}

/** Algorithms of which there is something newer than before, where that was preliminary; nothing is left of a cancelled run. */
export function renewed(before: readonly AlgorithmResult[], now: readonly AlgorithmResult[]): string[] {
  const changed = ({ algorithm }: AlgorithmResult) => now.some((result) => result.algorithm === algorithm && !before.includes(result))
  return before.filter((old) => old.preliminary && changed(old)).map(({ algorithm }) => algorithm)
}

/** Preliminary results are fetched again when there are newer ones; until then the picture stays. */
function useRenewal(what: 'heatmap' | 'ecdf', run: ComputedRef<RunInfo>): void {
  const client = useQueryClient()
  watch(run, (now, before) => {
    if (now.id !== before.id) return
    for (const algorithm of renewed(before.results, now.results)) void client.invalidateQueries({ queryKey: [what, now.id, algorithm] })
  })
}

/** A finished run never changes, so what was fetched stays good. */
const staleTime = ({ state }: { state: { data?: { preliminary: boolean } | undefined } }): number => (state.data?.preliminary ? 0 : Number.POSITIVE_INFINITY)

// Tens of thousands of numbers are read as they are: Vue would watch each of them, and a new answer would be compared with the
// old one number by number.

/** The heatmaps on the screen. */
export function useHeatmaps(run: ComputedRef<RunInfo>, state: ComputedRef<ExplorerState>): ComputedRef<PaneData[]> {
  useRenewal('heatmap', run)
  // While it is measured, a run changes several times a second, but its pictures seldom do.
  const runId = computed(() => run.value.id)
  const visible = steadyList(() => visibleAlgorithms(run.value, state.value))
  const queries = useQueries({
    queries: computed(() =>
      visible.value.map(({ id }) => {
        const request = heatmapRequest(state.value, id)
        return {
          queryKey: ['heatmap', runId.value, id, request],
          queryFn: async () => markRaw(await getHeatmap(runId.value, request)),
          staleTime,
          structuralSharing: false,
        }
      }),
    ),
  })
  const order = computed(() => measured(run.value).map(({ id }) => id))
  return steadyList(() =>
    visible.value.map(({ id, name }, i) => {
      const query = queries.value[i]
      return {
        algorithm: id,
        title: (state.value.measure === 'density' ? 'Configuration set' : name) + minus(run.value, state.value),
        heatmap: query?.data ?? null,
        error: query?.error?.message ?? null,
        series: state.value.measure === 'density' ? null : order.value.indexOf(id),
      }
    }),
  )
}

/** The distributions of the time per query, of the first four measured algorithms. */
export function useEcdfs(run: ComputedRef<RunInfo>): ComputedRef<{ name: string; curve: Ecdf }[]> {
  useRenewal('ecdf', run)
  const runId = computed(() => run.value.id)
  const shown = steadyList(() => measured(run.value).slice(0, MAX_PANES))
  const queries = useQueries({
    queries: computed(() =>
      shown.value.map(({ id }) => ({
        queryKey: ['ecdf', runId.value, id],
        queryFn: async () => markRaw(await getEcdf(runId.value, id)),
        staleTime,
        structuralSharing: false,
      })),
    ),
  })
  return steadyList(() =>
    shown.value.flatMap(({ name }, i) => {
      const curve = queries.value[i]?.data
      return curve ? [{ name, curve }] : []
    }),
  )
}

