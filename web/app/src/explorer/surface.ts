import { type BufferGeometry, Mesh } from 'three'
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js'
import { takeMesh } from './surface-ahead'

/** Fetches an object's surface. Vertices and triangles come in the order of the object, which heatmaps rely on. */
export async function loadSurface(object: string, signal?: AbortSignal): Promise<BufferGeometry> {
  return readSurface(await takeMesh(object, signal))
}

/** The one mesh of a binary glTF. */
export async function readSurface(glb: ArrayBuffer): Promise<BufferGeometry> {
  const { scene } = await new GLTFLoader().parseAsync(glb, '')
  let found: BufferGeometry | null = null
  scene.traverse((node) => {
    if (found || !(node instanceof Mesh)) return
    found = node.geometry as BufferGeometry
    found.userData.origin = node.position.toArray()
  })
  const geometry = found as BufferGeometry | null
  if (!geometry?.index) throw new Error('The surface from the service has no indexed triangles.')
  return geometry
}

/** From where the positions of a surface count, in the object's frame: single precision would lose the detail of a small object far away. */
export function originOf(surface: BufferGeometry): [number, number, number] {
  return (surface.userData.origin as [number, number, number] | undefined) ?? [0, 0, 0]
}
