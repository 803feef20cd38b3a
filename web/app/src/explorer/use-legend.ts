import { computed, type ComputedRef } from 'vue'
import type { Heatmap } from '../api/types'
import { count, value as withUnit } from '../ui/format'
import { FAILURE, isSampled, isShare, MEASURE, STATISTIC } from '../ui/words'
import { coverage, type Coverage } from './datum'
import { histogram, sharedScale, sortedValues, type ColourScale, type ScaleKind } from './scale'
import { differs, type ExplorerState } from './url-state'

/** What the legend shows for the maps on the screen. */
export interface LegendData {
  scale: ColourScale
  unit: string
  name: string
  n: number
  range: [number, number]
  bars: number[]
  coverage: Coverage
}

export const LEGEND_BARS = 72

/** One scale and one legend for all maps on the screen; null until one of them has a value. */
export function useLegend(maps: ComputedRef<Heatmap[]>, state: ComputedRef<ExplorerState>): ComputedRef<LegendData | null> {
  // Sorting is the expensive part and does not depend on the scale.
  const sorted = computed(() => sortedValues(maps.value.map(({ values }) => values)))
  const covered = computed(() => coverage(maps.value))
  return computed(() => {
    const [first] = maps.value
    const { measure, log, range } = state.value
    const scale = sharedScale(sorted.value, log && !isShare(measure), range, scaleKind(state.value))
    if (!first || !scale) return null
    return {
      scale,
      unit: first.unit,
      name: legendName(state.value),
      n: Math.max(...maps.value.map(({ n }) => n)),
      range: [sorted.value[0] ?? 0, sorted.value.at(-1) ?? 0],
      bars: histogram(sorted.value, scale, LEGEND_BARS),
      coverage: isSampled(measure) ? covered.value : { ...covered.value, few: 0 },
    }
  })
}

/** What the colours have to show. */
export function scaleKind(state: ExplorerState): ScaleKind {
  if (differs(state)) return 'differences'
  return state.measure in FAILURE ? 'failures' : 'values'
}

/** `Median of time per query`. */
export function legendName(state: ExplorerState): string {
  const { measure, statistic } = state
  const difference = differs(state) ? ', difference: above 0 the first is larger' : ''
  if (measure === 'density') return `Density: configurations with a witness point here${difference}`
  if (isShare(measure)) return `${MEASURE[measure]}, share${difference}`
  const name = STATISTIC[statistic]
  if (measure === 'triangle_tests') return `Primitive tests per query in which a triangle takes part, ${name} at each vertex${difference}`
  const what =
    { time: 'time', bv_tests: 'BV tests', primitive_tests: 'primitive tests', distance_error: 'distance error' }[measure as string] ??
    MEASURE[measure]
  return `${name === 'MAD' ? name : name[0]?.toUpperCase() + name.slice(1)} of ${what} per query${difference}`
}

/** A sentence on what maps of failures show: where it is 0 and where it is not. */
export function failureWords(name: string, map: Heatmap): string {
  const reached = map.values.filter((value) => value !== null)
  const failing = reached.filter((value) => value > 0)
  if (reached.length === 0) return `${name}: no vertex has a value.`
  if (failing.length === 0) return `${name}: 0 at all ${count(reached.length)} vertices that have a value.`
  const most = withUnit(Math.max(...failing), map.unit)
  return `${name}: above 0 at ${count(failing.length)} of ${count(reached.length)} vertices, at most ${most}.`
}
