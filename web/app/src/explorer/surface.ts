import { type BufferGeometry, Mesh } from 'three'
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js'
import { fetchMesh } from '../api/client'

/** Fetches an object's surface. Vertices and triangles come in the order of the object, which heatmaps rely on. */
export async function loadSurface(object: string, signal?: AbortSignal): Promise<BufferGeometry> {
  return readSurface(await fetchMesh(object, signal))
}

/** The one mesh of a binary glTF. */
export async function readSurface(glb: ArrayBuffer): Promise<BufferGeometry> {
  const { scene } = await new GLTFLoader().parseAsync(glb, '')
  let found: BufferGeometry | null = null
  scene.traverse((node) => {
    if (!found && node instanceof Mesh) found = node.geometry as BufferGeometry
  })
  const geometry = found as BufferGeometry | null
  if (!geometry?.index) throw new Error('The surface from the service has no indexed triangles.')
  return geometry
}
