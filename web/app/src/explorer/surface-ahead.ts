import { fetchMesh } from '../api/client'

let ahead: { object: string; glb: Promise<ArrayBuffer> } | null = null

/** Fetches the surface that will be drawn next. */
export function fetchAhead(object: string): void {
  if (ahead?.object === object) return
  const glb = fetchMesh(object)
  // The view that needs it asks again, and reports the error.
  glb.catch(() => {})
  ahead = { object, glb }
}

/** An object's surface, fetched ahead or now. */
export function takeMesh(object: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  const glb = ahead?.object === object ? ahead.glb : null
  ahead = null
  return glb?.catch(() => fetchMesh(object, signal)) ?? fetchMesh(object, signal)
}
