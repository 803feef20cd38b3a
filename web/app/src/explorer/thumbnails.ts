import { Mesh, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer } from 'three'
import { BufferAttribute } from 'three'
import { heatmapMaterial, setNeutrals } from './shader'
import { graphics } from './software'
import { whenIdle } from '../ui/idle'
import { loadSurface } from './surface'

/** Draws small pictures of objects, one after the other, with one renderer that is given up at the end. */
export class Thumbnails {
  private readonly renderer: WebGLRenderer | null
  private readonly material = heatmapMaterial()
  private queue: Promise<void> = Promise.resolve()
  private readonly abort = new AbortController()

  constructor(private readonly width: number, private readonly height: number) {
    this.renderer = graphics().available ? new WebGLRenderer({ alpha: true, antialias: !graphics().software }) : null
    this.renderer?.setSize(width, height, false)
  }

  /** Puts the picture of an object onto a canvas when its turn comes; the canvas stays empty when it cannot be drawn. */
  draw(object: string, target: HTMLCanvasElement): void {
    this.queue = this.queue.then(whenIdle).then(() => this.render(object, target)).catch(() => {
      // A card without a picture is still a card; the list itself reports a service that does not answer.
    })
  }

  dispose(): void {
    this.abort.abort()
    this.material.dispose()
    this.renderer?.dispose()
    this.renderer?.forceContextLoss()
  }

  private async render(object: string, target: HTMLCanvasElement): Promise<void> {
    const { renderer } = this
    if (!renderer || this.abort.signal.aborted) return
    const geometry = await loadSurface(object, this.abort.signal)
    if (this.abort.signal.aborted) return geometry.dispose()
    if (!geometry.getAttribute('normal')) geometry.computeVertexNormals()
    geometry.setAttribute('datum', new BufferAttribute(new Float32Array(geometry.getAttribute('position').count * 4), 4))
    geometry.computeBoundingSphere()
    const { center, radius } = geometry.boundingSphere ?? new Sphere(new Vector3(), 1)
    const colour = getComputedStyle(target).color
    setNeutrals(this.material, { noData: colour, outside: colour, hatch: colour })
    const camera = new PerspectiveCamera(30, this.width / this.height, radius / 20, radius * 20)
    camera.position.copy(center).add(new Vector3(0.5, 0.38, 1).normalize().multiplyScalar(radius * 3.5))
    camera.lookAt(center)
    const scene = new Scene().add(new Mesh(geometry, this.material))
    renderer.render(scene, camera)
    target.width = this.width
    target.height = this.height
    target.getContext('2d')?.drawImage(renderer.domElement, 0, 0)
    geometry.dispose()
  }
}
