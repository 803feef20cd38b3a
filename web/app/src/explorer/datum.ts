/** With fewer values than this a statistic says little: the vertex is drawn paler. */
export const FEW = 8

/** The parts of a heatmap that colour a vertex. */
export interface VertexData {
  values: readonly (number | null)[]
  counts: readonly number[]
  /** Absent where none is dropped. */
  dropped?: readonly number[]
}

type Datum = Float32Array<ArrayBuffer>
const made = [new WeakMap<VertexData, Datum>(), new WeakMap<VertexData, Datum>()] as const

/** What the shader reads per vertex: value, has a value, lost all values to outlier removal, trust 0..1. The same for the same map. */
export function datum(map: VertexData, fadeFew: boolean): Datum {
  const known = made[fadeFew ? 1 : 0]
  const out = known.get(map) ?? make(map, fadeFew)
  known.set(map, out)
  return out
}

function make(map: VertexData, fadeFew: boolean): Datum {
  const out = new Float32Array(map.values.length * 4)
  map.values.forEach((value, i) => {
    const has = value !== null && Number.isFinite(value)
    out[i * 4] = has ? value : 0
    out[i * 4 + 1] = has ? 1 : 0
    out[i * 4 + 2] = !has && (map.dropped?.[i] ?? 0) > 0 ? 1 : 0
    out[i * 4 + 3] = fadeFew ? Math.min(1, (map.counts[i] ?? 0) / FEW) : 1
  })
  return out
}

/** How many vertices are in which state. */
export interface Coverage {
  maps: number
  vertices: number
  coloured: number
  noData: number
  allDropped: number
  few: number
}

/** Counts the states over one or more maps (a vertex of two maps counts twice). */
export function coverage(maps: readonly VertexData[]): Coverage {
  const total: Coverage = { maps: maps.length, vertices: 0, coloured: 0, noData: 0, allDropped: 0, few: 0 }
  for (const map of maps) {
    map.values.forEach((value, i) => {
      total.vertices++
      if (value !== null) {
        total.coloured++
        if ((map.counts[i] ?? 0) < FEW) total.few++
      } else if ((map.dropped?.[i] ?? 0) > 0) total.allDropped++
      else total.noData++
    })
  }
  return total
}
