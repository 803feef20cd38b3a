import { DoubleSide, Vector3, type BufferGeometry, type Ray } from 'three'
import { MeshBVH } from 'three-mesh-bvh'

/** A place on the surface. */
export interface Hit {
  /** Triangle, numbered as in the object's file. */
  triangle: number
  /** The corner of that triangle next to the place. */
  vertex: number
}

/**
 * The search structure over a surface.
 *
 * `indirect` is what keeps triangle numbers true: without it three-mesh-bvh sorts the index buffer in place, and every
 * triangle id of the benchmark would name another triangle.
 */
export function buildBvh(geometry: BufferGeometry): MeshBVH {
  return new MeshBVH(geometry, { indirect: true })
}

/** Where a ray (in the object's frame) first meets the surface. */
export function pick(bvh: MeshBVH, ray: Ray): Hit | null {
  const hit = bvh.raycastFirst(ray, DoubleSide)
  if (!hit || hit.faceIndex === undefined || hit.faceIndex === null) return null
  const triangle = hit.faceIndex
  const vertex = nearestCorner(bvh.geometry, triangle, hit.point)
  return vertex === null ? null : { triangle, vertex }
}

/** The corner of a triangle next to a point. */
export function nearestCorner(geometry: BufferGeometry, triangle: number, point: Vector3): number | null {
  const { index } = geometry
  const positions = geometry.getAttribute('position')
  if (!index || !positions) return null
  const corner = new Vector3()
  let best: number | null = null
  let bestDistance = Number.POSITIVE_INFINITY
  for (let k = 0; k < 3; k++) {
    const vertex = index.getX(triangle * 3 + k)
    const distance = corner.fromBufferAttribute(positions, vertex).distanceToSquared(point)
    if (distance < bestDistance) {
      best = vertex
      bestDistance = distance
    }
  }
  return best
}
