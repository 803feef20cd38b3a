import type { QueryClient } from '@tanstack/vue-query'
import { putInList } from '../api/in-list'
import type { ObjectInfo } from '../api/types'

/** Ids of procedural stock objects: `stock:NAME@TRIANGLES`. */
const PROCEDURAL = /^stock:([^@]+)@(\d+)$/

/** Bounds of the slider for procedural objects. */
export const TRIANGLES = { least: 500, most: 500_000 } as const

/** The number of triangles of a procedural id; null for all other objects, whose number is fixed. */
export function proceduralTriangles(id: string): number | null {
  const found = PROCEDURAL.exec(id)
  return found ? Number(found[2]) : null
}

/** What stays the same while the number of triangles changes: the name of a stock object, or the id. */
export function objectKey(id: string): string {
  return PROCEDURAL.exec(id)?.[1] ?? id.replace(/^stock:/, '')
}

/** The same object with another number of triangles. */
export function withTriangles(id: string, triangles: number): string {
  const found = PROCEDURAL.exec(id)
  return found ? `stock:${found[1]}@${triangles}` : id
}

/** An id whose surface is quickly fetched, for thumbnails. */
export function coarse(id: string, most = 3000): string {
  const triangles = proceduralTriangles(id)
  return triangles === null ? id : withTriangles(id, Math.min(triangles, most))
}

/** The listed object that an id belongs to, at whatever number of triangles. */
export function find(objects: readonly ObjectInfo[], id: string): ObjectInfo | undefined {
  return objects.find((object) => object.id === id) ?? objects.find((object) => objectKey(object.id) === objectKey(id))
}

/** Slider positions 0..1000 are logarithmic in the number of triangles, rounded to two digits. */
export function sliderToTriangles(at: number): number {
  const exact = TRIANGLES.least * (TRIANGLES.most / TRIANGLES.least) ** (at / 1000)
  return Number(exact.toPrecision(2))
}

export function trianglesToSlider(triangles: number): number {
  return Math.round((1000 * Math.log(triangles / TRIANGLES.least)) / Math.log(TRIANGLES.most / TRIANGLES.least))
}

/** Puts an uploaded object behind the others of the list. */
export const addObject = (cache: QueryClient, object: ObjectInfo): Promise<void> =>
  putInList<ObjectInfo>(cache, 'objects', (old) => [...old.filter(({ id }) => id !== object.id), object])
