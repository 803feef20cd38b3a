import { Box3, type BufferGeometry, DoubleSide, Matrix4, Mesh, MeshLambertMaterial, Sphere, Vector3 } from 'three'
import { Stage } from '../explorer/stage'
import { originOf } from '../explorer/surface'

/** How an object is drawn: as the others, strongly because it collides, or strongly because its pair is chosen. */
export type Tone = 'usual' | 'hit' | 'chosen'

const COLOUR: Record<Tone, string> = { usual: '--series-0', hit: '--bad', chosen: '--series-1' }

/** An object in its place. */
export interface Placed {
  surface: BufferGeometry
  /** Row-major. */
  pose: readonly number[]
  tone: Tone
}

/** Draws objects of a scene, z up as robots and simulators have it, some of them in a colour of their own. */
export class SceneViewer extends Stage {
  show(objects: readonly Placed[]): void {
    this.clear()
    this.content.rotation.x = -Math.PI / 2
    const [first] = objects
    if (!first) return
    // Drawn about the first object: the graphics card has single precision, and a scene may be far from the origin.
    const about = new Vector3().setFromMatrixPosition(new Matrix4().fromArray([...first.pose]).transpose())
    for (const { surface, pose, tone } of objects) {
      if (!surface.getAttribute('normal')) surface.computeVertexNormals()
      const placed = new Matrix4().fromArray([...pose]).transpose().multiply(new Matrix4().makeTranslation(new Vector3(...originOf(surface))))
      placed.premultiply(new Matrix4().makeTranslation(about.clone().negate()))
      const strong = tone !== 'usual'
      const material = new MeshLambertMaterial({
        color: this.colour(COLOUR[tone]), side: DoubleSide, transparent: true, opacity: strong ? 0.85 : 0.4, depthWrite: strong,
      })
      const mesh = new Mesh(surface, material)
      this.place(mesh, placed, strong ? 1 : 2)
    }
    this.content.updateMatrixWorld(true)
    this.rig.fit(new Box3().setFromObject(this.content, true).getBoundingSphere(new Sphere()))
    this.invalidate()
  }

  override dispose(): void {
    this.clear()
    super.dispose()
  }

  private clear(): void {
    for (const node of this.content.children) if (node instanceof Mesh) (node.material as MeshLambertMaterial).dispose()
    this.content.clear()
  }
}
