import { MathUtils, Spherical, Vector3, type PerspectiveCamera, type Sphere } from 'three'
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js'

export interface CameraEvents {
  /** On each change. */
  moved: () => void
  /** When a movement has ended; the six numbers of `view`. */
  rested: (view: number[]) => void
  /** A click (no drag) at client coordinates. */
  clicked: (x: number, y: number) => void
}

const STEP = MathUtils.degToRad(10)
const ZOOM = 1.15
/** A pointer that moved less is a click, pixels. */
const CLICK = 5
/** From the front, a little from the right and above. */
const START = new Spherical(1, MathUtils.degToRad(72), MathUtils.degToRad(28))

/** The one camera of a viewer: orbit by pointer and by arrows, zoom by wheel (once focused), pinch, plus and minus. */
export class CameraRig {
  private readonly controls: OrbitControls
  private sphere: Sphere | null = null
  private wanted: readonly number[] | null = null
  private down: [number, number] | null = null
  /** Position and target before the pointer went down. */
  private before: [Vector3, Vector3] | null = null
  private rest = 0
  /** The view that was last told. */
  private resting = ''
  private readonly abort = new AbortController()

  constructor(
    private readonly camera: PerspectiveCamera,
    private readonly element: HTMLElement,
    private readonly events: CameraEvents,
  ) {
    this.controls = new OrbitControls(camera, element)
    this.controls.enableDamping = false
    // A vertical swipe over the picture still scrolls the page, until the reader has chosen the picture by a tap.
    element.style.touchAction = 'pan-y'
    this.controls.addEventListener('change', events.moved)
    this.controls.addEventListener('end', () => this.rested())
    const { signal } = this.abort
    element.addEventListener('keydown', (event) => this.key(event), { signal })
    // The wheel belongs to the page until the reader has chosen the picture.
    element.addEventListener('wheel', () => this.wheel(), { signal, capture: true, passive: true })
    element.addEventListener('focusin', () => (element.style.touchAction = 'none'), { signal })
    element.addEventListener('focusout', () => (element.style.touchAction = 'pan-y'), { signal })
    element.addEventListener('pointerdown', (event) => this.press(event), { signal })
    element.addEventListener('pointerup', (event) => this.up(event), { signal })
    element.addEventListener('pointercancel', () => this.cancel(), { signal })
  }

  /** Looks at the whole object, unless a view was asked for before. */
  fit(sphere: Sphere): void {
    this.sphere = sphere.clone()
    this.camera.near = sphere.radius / 50
    this.camera.far = sphere.radius * 50
    this.controls.minDistance = sphere.radius * 0.15
    this.controls.maxDistance = sphere.radius * 20
    if (this.wanted) this.apply(this.wanted)
    else this.reset()
    this.resting = this.view().join()
  }

  /** The starting view. */
  reset(): void {
    if (!this.sphere) return
    this.wanted = null
    clearTimeout(this.rest)
    const offset = new Vector3().setFromSpherical(START).multiplyScalar(this.distance())
    this.controls.target.copy(this.sphere.center)
    this.camera.position.copy(this.sphere.center).add(offset)
    this.controls.update()
    this.events.moved()
  }

  /** Position and target relative to the object's bounding sphere: the same view of another level of detail. */
  view(): number[] {
    const { sphere } = this
    if (!sphere) return []
    const relative = (v: Vector3) => v.clone().sub(sphere.center).divideScalar(sphere.radius).toArray()
    return [...relative(this.camera.position), ...relative(this.controls.target)].map((x) => Math.round(x * 100) / 100)
  }

  /** The inverse of `view`; kept until there is an object. */
  show(view: readonly number[]): void {
    this.wanted = view
    if (this.sphere) this.apply(view)
  }

  /** The pane about to be drawn; a narrow one sees the same object from the same place, wider. */
  aspect(aspect: number): void {
    const base = 30
    this.camera.aspect = aspect
    this.camera.fov =
      aspect >= 1 ? base : MathUtils.radToDeg(2 * Math.atan(Math.tan(MathUtils.degToRad(base / 2)) / aspect))
    this.camera.updateProjectionMatrix()
  }

  dispose(): void {
    clearTimeout(this.rest)
    this.abort.abort()
    this.controls.dispose()
  }

  private apply(view: readonly number[]): void {
    const { sphere } = this
    const [px, py, pz, tx, ty, tz] = view
    if (!sphere || px === undefined || py === undefined || pz === undefined) return
    const absolute = (x: number, y: number, z: number) =>
      new Vector3(x, y, z).multiplyScalar(sphere.radius).add(sphere.center)
    this.camera.position.copy(absolute(px, py, pz))
    this.controls.target.copy(absolute(tx ?? 0, ty ?? 0, tz ?? 0))
    this.controls.update()
    this.resting = this.view().join()
    this.events.moved()
  }

  private distance(): number {
    const half = MathUtils.degToRad(15)
    return ((this.sphere?.radius ?? 1) / Math.sin(half)) * 0.97
  }

  private key(event: KeyboardEvent): void {
    if (event.target instanceof HTMLInputElement || event.ctrlKey || event.metaKey || event.altKey) return
    const turn: Record<string, [number, number]> = {
      ArrowLeft: [-STEP, 0],
      ArrowRight: [STEP, 0],
      ArrowUp: [0, -STEP],
      ArrowDown: [0, STEP],
    }
    const by = turn[event.key]
    if (by) this.orbit(by[0], by[1], 1)
    else if (event.key === '+' || event.key === '=') this.orbit(0, 0, 1 / ZOOM)
    else if (event.key === '-' || event.key === '_') this.orbit(0, 0, ZOOM)
    else if (event.key === '0' || event.key === 'Home') this.reset()
    else return
    event.preventDefault()
    this.rested()
  }

  private orbit(azimuth: number, polar: number, distance: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target)
    const spherical = new Spherical().setFromVector3(offset)
    spherical.theta += azimuth
    spherical.phi = MathUtils.clamp(spherical.phi + polar, 0.02, Math.PI - 0.02)
    spherical.radius = MathUtils.clamp(spherical.radius * distance, this.controls.minDistance, this.controls.maxDistance)
    this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(spherical))
    this.controls.update()
    this.events.moved()
  }

  private wheel(): void {
    this.controls.enableZoom = this.element.contains(document.activeElement)
  }

  private press(event: PointerEvent): void {
    // A second finger makes it a pinch, which zooms whatever the wheel may do.
    this.down = event.isPrimary ? [event.clientX, event.clientY] : null
    if (event.isPrimary) this.before = [this.camera.position.clone(), this.controls.target.clone()]
    this.controls.enableZoom = true
  }

  /** The browser scrolls the page by this swipe; before it knew, the swipe may have turned the object. */
  private cancel(): void {
    if (!this.before) return
    this.camera.position.copy(this.before[0])
    this.controls.target.copy(this.before[1])
    this.controls.update()
    this.events.moved()
  }

  private up(event: PointerEvent): void {
    const { down } = this
    this.down = null
    if (down && event.button === 0 && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < CLICK) {
      this.events.clicked(event.clientX, event.clientY)
    }
  }

  private rested(): void {
    clearTimeout(this.rest)
    this.rest = window.setTimeout(() => {
      const view = this.view()
      // A click ends a movement too, of nothing.
      if (view.join() === this.resting) return
      this.resting = view.join()
      this.events.rested(view)
    }, 200)
  }
}
