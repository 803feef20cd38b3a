import {
  BufferAttribute, BufferGeometry, Color, Mesh, PerspectiveCamera, Plane, Points, PointsMaterial, Scene, Sphere, CanvasTexture, Vector2, Vector3,
  WebGLRenderer, Raycaster, SRGBColorSpace,
} from 'three'
import type { MeshBVH } from 'three-mesh-bvh'
import { CameraRig } from './camera'
import { PointCloud, type DrawnCloud } from './cloud/point-cloud'
import { strokes } from './cloud/stroke'
import type { Colormap } from './colormap'
import { buildBvh, pick, type Hit } from './picking'
import type { ColourScale } from './scale'
import { cssBytes, heatmapMaterial, setColormap, setNeutrals, setScale, setSelecting } from './shader'
import { graphics } from './software'

/** One picture of the object: where on the page, and what its vertices carry (null: plain). */
export interface Pane {
  element: HTMLElement
  datum: Float32Array<ArrayBuffer> | null
}

export interface ViewerEvents {
  /** The reader asked for the value at a place of pane number `pane`. */
  pick?: (hit: Hit, pane: number) => void
  /** The reader chose a region around a place: a double click, or B. */
  region?: (vertex: number) => void
  /** The reader drew a ball around a vertex over the points; the radius as a share of the longest side. */
  stroke?: (vertex: number, radius: number) => void
  /** The reader chose a picture of the wall. */
  open?: (pane: number) => void
  /** The camera came to rest. */
  camera?: (view: number[]) => void
}

/** How long after the last movement a software renderer draws at full resolution again, milliseconds. */
const SETTLE_MS = 150

/**
 * Draws one object in any number of panes of one canvas. One camera serves all panes, which is what keeps them in step;
 * positions, normals and triangles are on the graphics card once. Draws on demand only.
 */
export class HeatmapViewer {
  readonly rig: CameraRig
  /** On the wall a click opens a picture; else it reads a value. */
  wall = false
  private readonly renderer: WebGLRenderer
  private readonly scene = new Scene()
  private readonly camera = new PerspectiveCamera(30, 1, 0.01, 100)
  private readonly material = heatmapMaterial()
  private readonly marker = new Points(
    new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(3), 3)),
    new PointsMaterial({ size: 10, sizeAttenuation: false, depthTest: false, transparent: true, map: disc() }),
  )
  private readonly halo = new Points(this.marker.geometry, this.marker.material.clone())
  private readonly cloud = new PointCloud()
  /** The ball that is being drawn. */
  private stroke: { vertex: number; centre: Vector3; radius: number; pane: number } | null = null
  private readonly unstroke: () => void
  private base: BufferGeometry | null = null
  /** Per vertex: in the selection or not; shared by all panes. */
  private lit = new BufferAttribute(new Float32Array(0), 1)
  /** Built when the first place is read: it takes as long as drawing. */
  private bvh: MeshBVH | null = null
  private panes: { element: HTMLElement; mesh: Mesh }[] = []
  private readonly resize: ResizeObserver
  private frame = 0
  private settle = 0
  private moving = false

  constructor(
    private readonly stage: HTMLElement,
    private readonly canvas: HTMLCanvasElement,
    private readonly events: ViewerEvents = {},
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !graphics().software })
    this.renderer.setScissorTest(true)
    this.renderer.autoClear = false
    this.marker.renderOrder = 3
    this.halo.renderOrder = 2
    this.halo.material.size = 16
    this.marker.visible = this.halo.visible = false
    this.scene.add(this.cloud.object, this.halo, this.marker)
    this.rig = new CameraRig(this.camera, stage, {
      moved: () => this.move(),
      rested: (view) => this.events.camera?.(view),
      clicked: (x, y) => this.pickAt(x, y),
    })
    stage.addEventListener('dblclick', this.regionAt)
    this.unstroke = strokes(stage, {
      begin: (x, y) => this.beginStroke(x, y),
      grow: (x, y) => this.growStroke(x, y),
      end: (kept) => this.endStroke(kept),
    })
    this.resize = new ResizeObserver(() => this.invalidate())
    this.resize.observe(stage)
    this.theme()
  }

  /** Takes the object's surface; the viewer owns the geometry from here on. */
  setSurface(geometry: BufferGeometry): void {
    this.clearPanes(true)
    this.base?.dispose()
    if (!geometry.getAttribute('normal')) geometry.computeVertexNormals()
    geometry.computeBoundingSphere()
    geometry.computeBoundingBox()
    this.base = geometry
    this.bvh = null
    this.lit = new BufferAttribute(new Float32Array(this.vertices), 1)
    this.rig.fit(geometry.boundingSphere ?? new Sphere(new Vector3(), 1))
    this.mark(null)
  }

  /** Number of vertices of the surface, 0 before there is one. */
  get vertices(): number {
    return this.base?.getAttribute('position').count ?? 0
  }

  setPanes(panes: readonly Pane[]): void {
    this.clearPanes(false)
    const { base } = this
    if (!base) return
    this.panes = panes.map(({ element, datum }) => {
      const geometry = new BufferGeometry()
      geometry.setIndex(base.index)
      geometry.setAttribute('position', base.getAttribute('position'))
      geometry.setAttribute('normal', base.getAttribute('normal'))
      geometry.setAttribute('lit', this.lit)
      geometry.setAttribute('datum', new BufferAttribute(datum ?? new Float32Array(this.vertices * 4), 4))
      geometry.boundingSphere = base.boundingSphere
      const mesh = new Mesh(geometry, this.material)
      mesh.visible = false
      this.scene.add(mesh)
      return { element, mesh }
    })
    this.invalidate()
  }

  /** `shown` are positions on the scale: what lies outside is drawn without colour. */
  setScale(scale: ColourScale | null, shown: readonly [number, number]): void {
    setScale(this.material, scale, shown)
    this.invalidate()
  }

  /** Dims the surface outside the selected vertices; null: nothing is selected. */
  setLit(lit: Float32Array | null): void {
    const fits = lit !== null && lit.length === this.lit.count
    if (fits) {
      this.lit.array.set(lit)
      this.lit.needsUpdate = true
    }
    setSelecting(this.material, fits)
    this.invalidate()
  }

  /** Points over the surface; null: none. */
  setCloud(cloud: DrawnCloud | null): void {
    const before = this.cloud.object.visible
    this.cloud.show(cloud)
    if (before === this.cloud.object.visible) this.invalidate()
    else this.theme()
  }

  setColormap(name: Colormap): void {
    setColormap(this.material, name)
    this.cloud.colormap(name)
    this.invalidate()
  }

  /** Reads the theme's colours again. */
  theme(): void {
    const style = getComputedStyle(this.stage)
    // A custom property keeps `light-dark()` unresolved; a real property computes it.
    const resolve = (name: string) => {
      const probe = document.createElement('i')
      probe.style.color = `var(${name})`
      this.stage.append(probe)
      const { color } = getComputedStyle(probe)
      probe.remove()
      return color
    }
    // Under points the surface steps back.
    setNeutrals(this.material, { noData: resolve(this.cloud.object.visible ? '--outside' : '--no-data'), outside: resolve('--outside'), hatch: resolve('--ink-3') })
    this.cloud.outside(resolve('--ink-3'))
    const colour = (css: string) => cssBytes(css).map((byte) => byte / 255) as [number, number, number]
    this.marker.material.color.setRGB(...colour(style.color))
    this.halo.material.color.setRGB(...colour(resolve('--sheet')))
    // Opaque: some browsers without a graphics card show what is transparent as black.
    this.renderer.setClearColor(new Color().setRGB(...colour(resolve('--stage')), SRGBColorSpace), 1)
    this.invalidate()
  }

  /** Puts the marker on a vertex, in all panes. */
  mark(vertex: number | null): void {
    const positions = this.base?.getAttribute('position')
    const visible = vertex !== null && positions !== undefined && vertex < positions.count
    this.marker.visible = this.halo.visible = visible
    if (visible) {
      const at = new Vector3().fromBufferAttribute(positions, vertex)
      const target = this.marker.geometry.getAttribute('position')
      target.setXYZ(0, at.x, at.y, at.z)
      target.needsUpdate = true
      this.marker.geometry.computeBoundingSphere()
    }
    this.invalidate()
  }

  /** Reads the place in the middle of a pane: picking without a pointer. */
  pickCentre(pane: number): void {
    const box = this.panes[pane]?.element.getBoundingClientRect()
    if (box) this.pickAt(box.left + box.width / 2, box.top + box.height / 2)
  }

  /** The vertex in the middle of a pane; null where the surface is not. */
  centre(pane: number): number | null {
    const box = this.panes[pane]?.element.getBoundingClientRect()
    return (box && this.hitAt(box.left + box.width / 2, box.top + box.height / 2)?.hit.vertex) ?? null
  }

  /** Draws before the next repaint, however often it is asked. */
  invalidate(): void {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0
      this.draw()
    })
  }

  /** Draws now and hands out the canvas; its content is valid until the caller returns to the event loop. */
  snapshot(): HTMLCanvasElement {
    this.moving = false
    this.draw()
    return this.canvas
  }

  dispose(): void {
    cancelAnimationFrame(this.frame)
    clearTimeout(this.settle)
    this.resize.disconnect()
    this.stage.removeEventListener('dblclick', this.regionAt)
    this.unstroke()
    this.rig.dispose()
    this.cloud.dispose()
    this.clearPanes(true)
    this.base?.dispose()
    this.material.uniforms.map?.value.dispose()
    this.material.dispose()
    this.marker.geometry.dispose()
    this.marker.material.map?.dispose()
    this.marker.material.dispose()
    this.halo.material.dispose()
    this.renderer.dispose()
    this.renderer.forceContextLoss()
  }

  /** With `surfaceToo` the buffers that the panes share are freed as well; otherwise the next panes use them again. */
  private clearPanes(surfaceToo: boolean): void {
    for (const { mesh } of this.panes) {
      this.scene.remove(mesh)
      if (!surfaceToo) mesh.geometry.deleteAttribute('position').deleteAttribute('normal').deleteAttribute('lit').setIndex(null)
      mesh.geometry.dispose()
    }
    this.panes = []
  }

  private move(): void {
    this.moving = true
    clearTimeout(this.settle)
    this.settle = window.setTimeout(() => {
      this.moving = false
      this.invalidate()
    }, SETTLE_MS)
    this.invalidate()
  }

  private draw(): void {
    const stage = this.stage.getBoundingClientRect()
    if (stage.width === 0 || stage.height === 0) return
    const { software } = graphics()
    const ratio = software ? (this.moving ? 0.5 : 1) : Math.min(2, window.devicePixelRatio)
    const size = this.renderer.getSize(new Vector2())
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio)
    this.cloud.ratio(ratio)
    if (size.x !== stage.width || size.y !== stage.height) this.renderer.setSize(stage.width, stage.height, false)
    this.renderer.setViewport(0, 0, stage.width, stage.height)
    this.renderer.setScissor(0, 0, stage.width, stage.height)
    this.renderer.clear()
    for (const { element, mesh } of this.panes) {
      const box = element.getBoundingClientRect()
      const x = box.left - stage.left
      const y = stage.bottom - box.bottom
      this.rig.aspect(box.width / box.height)
      this.renderer.setViewport(x, y, box.width, box.height)
      this.renderer.setScissor(x, y, box.width, box.height)
      mesh.visible = true
      this.renderer.render(this.scene, this.camera)
      mesh.visible = false
    }
  }

  private readonly regionAt = (event: MouseEvent): void => {
    const found = this.hitAt(event.clientX, event.clientY)
    if (found) this.events.region?.(found.hit.vertex)
  }

  private pickAt(clientX: number, clientY: number): void {
    const pane = this.wall ? this.paneAt(clientX, clientY) : -1
    if (pane >= 0) return this.events.open?.(pane)
    const found = this.hitAt(clientX, clientY)
    if (found) this.events.pick?.(found.hit, found.pane)
  }

  private paneAt(clientX: number, clientY: number): number {
    return this.panes.findIndex(({ element }) => {
      const box = element.getBoundingClientRect()
      return clientX >= box.left && clientX < box.right && clientY >= box.top && clientY < box.bottom
    })
  }

  private hitAt(clientX: number, clientY: number): { hit: Hit; pane: number } | null {
    const pane = this.paneAt(clientX, clientY)
    const ray = this.rayAt(clientX, clientY, pane)
    if (!ray || !this.base) return null
    this.bvh ??= buildBvh(this.base)
    const hit = pick(this.bvh, ray.ray)
    return hit && { hit, pane }
  }

  /** From the eye through a place of a pane. */
  private rayAt(clientX: number, clientY: number, pane: number): Raycaster | null {
    const box = this.panes[pane]?.element.getBoundingClientRect()
    if (!box) return null
    this.rig.aspect(box.width / box.height)
    const ray = new Raycaster()
    ray.setFromCamera(
      new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2),
      this.camera,
    )
    return ray
  }

  private beginStroke(x: number, y: number): boolean {
    const positions = this.base?.getAttribute('position')
    const found = this.cloud.object.visible ? this.hitAt(x, y) : null
    if (!found || !positions) return false
    const { vertex } = found.hit
    this.stroke = { vertex, centre: new Vector3().fromBufferAttribute(positions, vertex), radius: 0, pane: found.pane }
    return true
  }

  /** The ball reaches to the pointer, across the view. */
  private growStroke(x: number, y: number): void {
    const ray = this.stroke && this.rayAt(x, y, this.stroke.pane)
    if (!this.stroke || !ray) return
    const plane = new Plane().setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), this.stroke.centre)
    this.stroke.radius = ray.ray.intersectPlane(plane, new Vector3())?.distanceTo(this.stroke.centre) ?? this.stroke.radius
    this.cloud.ball(this.stroke.centre, this.stroke.radius)
    this.invalidate()
  }

  private endStroke(kept: boolean): void {
    const { stroke } = this
    this.stroke = null
    this.cloud.ball(new Vector3(), 0)
    this.invalidate()
    const sides = this.base?.boundingBox?.getSize(new Vector3()).toArray() ?? [1]
    const share = stroke ? stroke.radius / Math.max(...sides) : 0
    if (!kept || !stroke) return
    // Hardly moved, it is a click.
    if (share < 0.005) this.events.region?.(stroke.vertex)
    else this.events.stroke?.(stroke.vertex, share)
  }
}

/** A white disc: points are squares otherwise. */
function disc(): CanvasTexture {
  const canvas = document.createElement('canvas')
  canvas.width = canvas.height = 32
  const context = canvas.getContext('2d')
  if (context) {
    context.fillStyle = '#fff'
    context.arc(16, 16, 15, 0, 2 * Math.PI)
    context.fill()
  }
  return new CanvasTexture(canvas)
}
