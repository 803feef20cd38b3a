import {
  Box3, BufferAttribute, BufferGeometry, DoubleSide, Line, LineBasicMaterial, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, Sphere,
  SphereGeometry, Vector3,
} from 'three'
import { Stage } from '../stage'
import { originOf } from '../surface'

/** One configuration to look at: poses row-major, points in the world, pairs of triangles that meet. */
export interface Posed {
  poseA: readonly number[]
  poseB: readonly number[]
  points: readonly (readonly number[])[]
  /** Triangles to light, of A and of B. */
  triangles: readonly [readonly number[], readonly number[]]
  /** What a wrong answer points at: triangles of A and of B, and points in the world. */
  claimed: { triangles: readonly [readonly number[], readonly number[]]; points: readonly (readonly number[])[] }
  /** Look at the points and what is claimed, not at the whole objects. */
  close: boolean
}

/** Of the whole scene, the least that a close look shows. */
const CLOSEST = 0.04

/** Draws both objects of one configuration, translucent, with witness points and lit triangles. */
export class PairViewer extends Stage {
  private readonly surfaces: [BufferGeometry, BufferGeometry]

  constructor(stage: HTMLElement, canvas: HTMLCanvasElement, a: BufferGeometry, b: BufferGeometry) {
    super(stage, canvas)
    this.surfaces = [a, b]
    for (const surface of new Set(this.surfaces)) if (!surface.getAttribute('normal')) surface.computeVertexNormals()
  }

  show(posed: Posed): void {
    this.clear()
    // Everything is drawn about a witness point: the graphics card has single precision, and objects may be far from the origin.
    const [x0 = 0, y0 = 0, z0 = 0] = posed.points[0] ?? []
    const about = new Vector3(x0, y0, z0)
    const poses = [posed.poseA, posed.poseB].map((pose, side) => {
      const origin = new Vector3(...originOf(this.surfaces[side === 0 ? 0 : 1]))
      const placed = new Matrix4().fromArray([...pose]).transpose().multiply(new Matrix4().makeTranslation(origin))
      return placed.premultiply(new Matrix4().makeTranslation(about.clone().negate()))
    })
    const box = new Box3()
    const vector = ([x = 0, y = 0, z = 0]: readonly number[]) => new Vector3(x, y, z).sub(about)
    const spots = [...posed.points, ...posed.claimed.points].map(vector)
    this.surfaces.forEach((surface, side) => {
      const pose = poses[side] ?? new Matrix4()
      const material = new MeshLambertMaterial({
        color: this.colour(side === 0 ? '--series-0' : '--series-1'), side: DoubleSide, transparent: true, opacity: side === 0 ? 0.42 : 0.34, depthWrite: false,
      })
      const mesh = new Mesh(surface, material)
      this.place(mesh, pose, 1)
      mesh.updateMatrixWorld(true)
      box.expandByObject(mesh, true)
      for (const [chosen, colour] of [[posed.triangles, '--bad'], [posed.claimed.triangles, '--series-3']] as const) {
        const lit = triangles(surface, chosen[side] ?? [])
        this.place(new Mesh(lit, this.bright(colour)), pose, 2)
        const corners = lit.getAttribute('position')
        if (chosen === posed.claimed.triangles)
          for (let i = 0; i < corners.count; i++) spots.push(new Vector3().fromBufferAttribute(corners, i).applyMatrix4(pose))
      }
    })
    const shown = box.getBoundingSphere(new Sphere())
    if (posed.close) {
      const least = CLOSEST * shown.radius
      shown.setFromPoints(spots)
      shown.radius = Math.max(least, 1.5 * shown.radius)
    }
    this.join(posed.points.map(vector), '--ink', shown.radius)
    this.join(posed.claimed.points.map(vector), '--series-3', shown.radius)
    this.rig.fit(shown)
    this.invalidate()
  }

  override dispose(): void {
    this.clear()
    for (const surface of this.surfaces) surface.dispose()
    super.dispose()
  }

  /** Dots, and a line through them. */
  private join(points: readonly Vector3[], colour: string, size: number): void {
    const dots = points.map((point) => {
      const dot = new Mesh(new SphereGeometry(size * 0.011, 16, 12), this.bright(colour))
      dot.position.copy(point)
      return dot
    })
    const line = new Line(
      new BufferGeometry().setFromPoints([...points]), new LineBasicMaterial({ color: this.colour(colour), depthTest: false, transparent: true }),
    )
    for (const node of [...dots, line]) {
      node.renderOrder = 3
      this.content.add(node)
    }
  }

  /** Seen through everything: what is transparent is drawn last, in the order that is asked for. */
  private bright(colour: string): MeshBasicMaterial {
    return new MeshBasicMaterial({ color: this.colour(colour), side: DoubleSide, depthTest: false, transparent: true })
  }

  private clear(): void {
    this.content.traverse((node) => {
      if (!(node instanceof Mesh || node instanceof Line)) return
      if (!this.surfaces.includes(node.geometry as BufferGeometry)) node.geometry.dispose()
      ;(node.material as MeshBasicMaterial).dispose()
    })
    this.content.clear()
  }
}

/** Some triangles of a surface, as a surface of their own. */
function triangles(surface: BufferGeometry, chosen: readonly number[]): BufferGeometry {
  const positions = surface.getAttribute('position')
  const { index } = surface
  const corners = chosen.flatMap((t) => [0, 1, 2].flatMap((k) => {
    const v = index?.getX(3 * t + k) ?? 0
    return [positions.getX(v), positions.getY(v), positions.getZ(v)]
  }))
  return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(corners), 3))
}
