import { Color, DirectionalLight, Group, HemisphereLight, type Matrix4, type Mesh, PerspectiveCamera, Scene, SRGBColorSpace, WebGLRenderer } from 'three'
import { CameraRig } from './camera'
import { cssBytes } from './shader'
import { graphics } from './software'

/** Objects in their places, lit, with a camera that turns around them. Draws on demand only. */
export class Stage {
  readonly rig: CameraRig
  protected readonly content = new Group()
  private readonly renderer: WebGLRenderer
  private readonly scene = new Scene()
  private readonly camera = new PerspectiveCamera(30, 1, 0.01, 100)
  private readonly resize: ResizeObserver
  private frame = 0

  constructor(
    private readonly element: HTMLElement,
    canvas: HTMLCanvasElement,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !graphics().software })
    const sun = new DirectionalLight(0xffffff, 1.6)
    sun.position.set(-0.4, 0.8, 0.9)
    this.camera.add(sun)
    this.scene.add(this.content, this.camera, new HemisphereLight(0xffffff, 0x8a8a80, 1.9))
    this.rig = new CameraRig(this.camera, element, { moved: () => this.invalidate(), rested: () => {}, clicked: () => {} })
    this.resize = new ResizeObserver(() => this.invalidate())
    this.resize.observe(element)
  }

  dispose(): void {
    cancelAnimationFrame(this.frame)
    this.resize.disconnect()
    this.rig.dispose()
    this.renderer.dispose()
    this.renderer.forceContextLoss()
  }

  protected place(mesh: Mesh, pose: Matrix4, order: number): void {
    mesh.matrixAutoUpdate = false
    mesh.matrix.copy(pose)
    mesh.renderOrder = order
    this.content.add(mesh)
  }

  /** A colour of the theme. */
  protected colour(name: string): Color {
    const probe = document.createElement('i')
    probe.style.color = `var(${name})`
    this.element.append(probe)
    const [r, g, b] = cssBytes(getComputedStyle(probe).color)
    probe.remove()
    return new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace)
  }

  invalidate(): void {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0
      const { width, height } = this.element.getBoundingClientRect()
      if (width === 0 || height === 0) return
      this.renderer.setPixelRatio(graphics().software ? 1 : Math.min(2, window.devicePixelRatio))
      this.renderer.setSize(width, height, false)
      this.renderer.setClearColor(this.colour('--stage'), 1)
      this.rig.aspect(width / height)
      this.renderer.render(this.scene, this.camera)
    })
  }
}
