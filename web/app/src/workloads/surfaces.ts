import type { BufferGeometry } from 'three'
import { onScopeDispose } from 'vue'
import { getWorkloadMesh } from '../api/workloads'
import { readSurface } from '../explorer/surface'

/** An object's surface, which stays its giver's. */
export type Surfaces = (object: number) => Promise<BufferGeometry>

/** The surfaces of a scene, each fetched once, for as long as the caller is there. */
export function useSurfaces(id: () => string): Surfaces {
  const known = new Map<string, Promise<BufferGeometry>>()
  onScopeDispose(() => {
    for (const one of known.values()) void one.then((geometry) => geometry.dispose(), () => {})
  })
  return (object) => {
    const key = `${id()} ${object}`
    const surface = known.get(key) ?? getWorkloadMesh(id(), object).then(readSurface)
    known.set(key, surface)
    // What could not be fetched may be asked for again.
    surface.catch(() => known.delete(key))
    return surface
  }
}
