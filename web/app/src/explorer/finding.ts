import type { Heatmap } from '../api/types'
import { FEW } from './datum'
import { percent, significant, value as withUnit } from '../ui/format'
import { quantile } from './scale'

/** Share of the vertices that counts as the hot part. */
const HOT = 0.05

/**
 * One sentence on what a map of times shows: how much more the slowest twentieth of the surface costs than the middle.
 * Vertices with few values stay out, because their extremes are chance. Null when too little is left to speak of.
 */
export function finding(name: string, map: Heatmap): string | null {
  const values = map.values
    .flatMap((value, i) => (value !== null && (map.counts[i] ?? 0) >= FEW ? [value] : []))
    .toSorted((a, b) => a - b)
  if (values.length < 100) return null
  const sorted = Float64Array.from(values)
  const middle = quantile(sorted, 0.5)
  const hot = quantile(sorted, 1 - HOT)
  if (middle <= 0) return null
  const times = hot / middle
  if (times < 1.15) return `${name} costs nearly the same everywhere: ${withUnit(middle, map.unit)} at the median vertex.`
  return `The slowest ${percent(HOT)} of the surface cost ${name} at least ${significant(times, 2)}× its median.`
}
