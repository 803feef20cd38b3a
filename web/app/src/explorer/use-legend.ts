import { computed, type ComputedRef } from 'vue'
import type { Heatmap } from '../api/types'
import { MEASURE, STATISTIC } from '../ui/words'
import { coverage, type Coverage } from './datum'
import { histogram, sharedScale, sortedValues, type ColourScale } from './scale'
import type { ExplorerState } from './url-state'

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

const BARS = 72

/** One scale and one legend for all maps on the screen; null until one of them has a value. */
export function useLegend(maps: ComputedRef<Heatmap[]>, state: ComputedRef<ExplorerState>): ComputedRef<LegendData | null> {
  // Sorting is the expensive part and does not depend on the scale.
  const sorted = computed(() => sortedValues(maps.value.map(({ values }) => values)))
  const covered = computed(() => coverage(maps.value))
  return computed(() => {
    const [first] = maps.value
    const scale = sharedScale(sorted.value, state.value.log, state.value.range)
    if (!first || !scale) return null
    return {
      scale,
      unit: first.unit,
      name: legendName(state.value),
      n: Math.max(...maps.value.map(({ n }) => n)),
      range: [sorted.value[0] ?? 0, sorted.value.at(-1) ?? 0],
      bars: histogram(sorted.value, scale, BARS),
      // The counts of a density are its values: few of them are no doubt about it.
      coverage: state.value.measure === 'density' ? { ...covered.value, few: 0 } : covered.value,
    }
  })
}

/** `Median of time per query`. */
export function legendName({ measure, statistic }: ExplorerState): string {
  if (measure === 'density') return 'Density: configurations with a witness point here'
  const name = STATISTIC[statistic]
  const what = { time: 'time', bv_tests: 'BV tests', primitive_tests: 'primitive tests' }[measure] ?? MEASURE[measure]
  return `${name === 'MAD' ? name : name[0]?.toUpperCase() + name.slice(1)} of ${what} per query`
}
