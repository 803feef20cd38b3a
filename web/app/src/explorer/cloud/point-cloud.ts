import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial, Vector4, type Vector3 } from 'three'
import type { Colormap } from '../colormap'
import { lutTexture, setColormap, setNeutrals } from '../shader'

/** Points over the surface. */
export interface DrawnCloud {
  positions: Float32Array
  /** Position of each on the colour map, 0 to 1; 2 less for those outside the selection. */
  at: Float32Array
}

/**
 * A point stands a little before the surface on which it lies. A ball (centre, radius) that is being drawn decides in
 * place of the selection.
 */
const VERTEX = /* glsl */ `
attribute float at;
uniform float size;
uniform vec4 ball;
varying float vAt;
varying float vIn;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  view.xyz *= 0.996;
  bool chosen = ball.w > 0.0 ? distance(position, ball.xyz) <= ball.w : at >= 0.0;
  vAt = at < 0.0 ? at + 2.0 : at;
  vIn = chosen ? 1.0 : 0.0;
  gl_Position = projectionMatrix * view;
  gl_PointSize = chosen ? size : size * 0.6;
}`

const FRAGMENT = /* glsl */ `
uniform sampler2D map;
uniform vec3 outside;
varying float vAt;
varying float vIn;
void main() {
  if (length(gl_PointCoord - 0.5) > 0.5) discard;
  vec3 colour = texture2D(map, vec2((clamp(vAt, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  gl_FragColor = vec4(vIn > 0.5 ? colour : outside, 1.0);
}`

const MANY = 8000

/** The closest points as the graphics card has them; in the colours of the legend. */
export class PointCloud {
  readonly object: Points<BufferGeometry, ShaderMaterial>
  private size = 0

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      toneMapped: false,
      uniforms: {
        map: { value: lutTexture() },
        outside: { value: new Color() },
        size: { value: 1 },
        ball: { value: new Vector4(0, 0, 0, 0) },
      },
    })
    this.object = new Points(new BufferGeometry(), material)
    this.object.frustumCulled = false
    this.object.visible = false
    this.object.renderOrder = 1
  }

  show(cloud: DrawnCloud | null): void {
    this.object.visible = cloud !== null
    if (!cloud) return
    const { geometry } = this.object
    if (geometry.getAttribute('position')?.array === cloud.positions) {
      geometry.setAttribute('at', new BufferAttribute(cloud.at, 1))
      return
    }
    geometry.dispose()
    this.object.geometry = new BufferGeometry()
      .setAttribute('position', new BufferAttribute(cloud.positions, 3))
      .setAttribute('at', new BufferAttribute(cloud.at, 1))
    this.size = cloud.at.length > MANY ? 3.5 : 5.5
  }

  /** Before each picture: device pixels per CSS pixel. */
  ratio(ratio: number): void {
    this.set('size', this.size * ratio)
  }

  /** The ball that is being drawn; radius 0 when none is. */
  ball(centre: Vector3, radius: number): void {
    this.set('ball', new Vector4(centre.x, centre.y, centre.z, radius))
  }

  colormap(name: Colormap): void {
    setColormap(this.object.material, name)
  }

  outside(css: string): void {
    setNeutrals(this.object.material, { outside: css })
  }

  dispose(): void {
    this.object.geometry.dispose()
    this.object.material.uniforms.map?.value.dispose()
    this.object.material.dispose()
  }

  private set(name: string, value: number | Vector4): void {
    const uniform = this.object.material.uniforms[name]
    if (uniform) uniform.value = value
  }
}
