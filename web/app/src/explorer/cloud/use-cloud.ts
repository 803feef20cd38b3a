import { computed, type ComputedRef } from 'vue'
import { count } from '../../ui/format'
import { histogram, position, sharedScale } from '../scale'
import type { Answer } from '../selecting/engine'
import type { ExplorerState } from '../url-state'
import { LEGEND_BARS, type LegendData } from '../use-legend'
import { RADIUS, type Cloud } from './density'
import type { DrawnCloud } from './point-cloud'

/** The closest points as they are drawn, and their legend; nothing while the view is off or they are on the way. */
export function useCloud(answer: ComputedRef<Answer | null>, state: ComputedRef<ExplorerState>) {
  const cloud = computed(() => {
    const { points, side } = state.value
    return points && answer.value?.cloud?.side === side ? answer.value.cloud : null
  })
  const sorted = computed(() => Float64Array.from(cloud.value?.near ?? []).toSorted())
  const scale = computed(() => sharedScale(sorted.value, state.value.log, state.value.range))
  const legend = computed<LegendData | null>(() =>
    cloud.value && scale.value
      ? {
          scale: scale.value,
          unit: 'points',
          name: cloudName(cloud.value),
          n: cloud.value.records.length,
          range: [sorted.value[0] ?? 0, sorted.value.at(-1) ?? 0],
          bars: histogram(sorted.value, scale.value, LEGEND_BARS),
          coverage: { maps: 1, vertices: 0, coloured: 0, noData: 0, allDropped: 0, few: 0 },
        }
      : null,
  )
  const drawn = computed<DrawnCloud | null>(() => {
    const { value: ends } = scale
    if (!cloud.value || !ends) return null
    const chosen = answer.value?.cloudChosen
    const at = Float32Array.from(cloud.value.near, (near, i) => position(ends, near) - (chosen && !chosen[i] ? 2 : 0))
    return { positions: cloud.value.positions, at }
  })
  return { cloud, legend, drawn }
}

/** `2,000 closest points, colour: points within 0.05 × the longest side`. */
export function cloudName({ records, of }: Pick<Cloud, 'records' | 'of'>): string {
  const drawn = records.length < of ? `${count(records.length)} of ${count(of)}` : count(of)
  return `${drawn} closest points, colour: points within ${RADIUS} × the longest side`
}
