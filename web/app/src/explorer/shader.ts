import { Color, DataTexture, DoubleSide, LinearFilter, RGBAFormat, ShaderMaterial, Vector2 } from 'three'
import { LUT_SIZE, lut, type Colormap } from './colormap'
import type { ColourScale } from './scale'

/**
 * Each vertex carries `datum` = (value, has a value, lost all values to outlier removal, trust 0..1).
 * The scalar is interpolated, not the colour: the value is weighted by "has a value", so a vertex without one takes
 * nothing from its neighbours and gives them nothing.
 */
const VERTEX = /* glsl */ `
attribute vec4 datum;
attribute float lit;
varying float vLit;
varying vec3 vScalar;
varying float vTrust;
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vView = view.xyz;
  vNormal = normalMatrix * normal;
  vScalar = vec3(datum.x * datum.y, datum.y, datum.z);
  vTrust = datum.w * datum.y;
  vLit = lit;
  gl_Position = projectionMatrix * view;
}`

/**
 * Shading keeps the brightness between 0.62 and 1, so that colours stay readable against the legend. Where the
 * interpolated normal and the triangle's own differ by much (the edge of a box), the triangle's is used.
 */
const FRAGMENT = /* glsl */ `
uniform sampler2D map;
uniform vec2 ends;
uniform vec2 shown;
uniform bool logarithmic;
uniform bool coloured;
uniform vec3 noData;
uniform vec3 outside;
uniform vec3 hatch;
uniform bool selecting;
varying float vLit;
varying vec3 vScalar;
varying float vTrust;
varying vec3 vNormal;
varying vec3 vView;

float place(float value) {
  if (!logarithmic) return (value - ends.x) / (ends.y - ends.x);
  return (log(max(value, 1e-30)) - log(ends.x)) / (log(ends.y) - log(ends.x));
}

void main() {
  vec3 base = noData;
  if (coloured && vScalar.y >= 0.5) {
    float at = place(vScalar.x / vScalar.y);
    float trust = vTrust / vScalar.y;
    base = texture2D(map, vec2((clamp(at, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
    base = mix(noData, base, 0.45 + 0.55 * clamp(trust, 0.0, 1.0));
    if (clamp(at, 0.0, 1.0) < shown.x || clamp(at, 0.0, 1.0) > shown.y) base = outside;
  } else if (coloured && vScalar.z >= 0.5) {
    float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 7.0);
    base = stripe < 0.42 ? hatch : noData;
  }
  // What is not selected steps back; its own colour still shows a little.
  if (selecting && vLit < 0.5) base = mix(base, outside, 0.86);
  vec3 flatNormal = normalize(cross(dFdx(vView), dFdy(vView)));
  vec3 smoothNormal = normalize(vNormal);
  if (!gl_FrontFacing) smoothNormal = -smoothNormal;
  vec3 n = mix(flatNormal, smoothNormal, smoothstep(0.72, 0.9, dot(flatNormal, smoothNormal)));
  vec3 eye = normalize(-vView);
  float light = 0.62 + 0.26 * max(dot(n, eye), 0.0) + 0.12 * max(dot(n, normalize(vec3(-0.4, 0.8, 0.5))), 0.0);
  gl_FragColor = vec4(base * light, 1.0);
}`

/** The surface material; colours are sRGB bytes straight to the screen, so that they equal the legend's. */
export function heatmapMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    side: DoubleSide,
    toneMapped: false,
    uniforms: {
      map: { value: lutTexture() },
      ends: { value: new Vector2(0, 1) },
      shown: { value: new Vector2(0, 1) },
      logarithmic: { value: false },
      coloured: { value: false },
      noData: { value: new Color() },
      outside: { value: new Color() },
      hatch: { value: new Color() },
      selecting: { value: false },
    },
  })
}

/** A colour map for a shader; `setColormap` puts another one in its place. */
export function lutTexture(): DataTexture {
  const texture = new DataTexture(lut('turbo'), LUT_SIZE, 1, RGBAFormat)
  texture.minFilter = LinearFilter
  texture.magFilter = LinearFilter
  texture.needsUpdate = true
  return texture
}

export function setColormap(material: ShaderMaterial, name: Colormap): void {
  const texture = uniform<DataTexture>(material, 'map')
  ;(texture.image.data as Uint8Array).set(lut(name))
  texture.needsUpdate = true
}

export function setScale(material: ShaderMaterial, scale: ColourScale | null, shown: readonly [number, number]): void {
  setUniform(material, 'coloured', scale !== null)
  if (!scale) return
  uniform<Vector2>(material, 'ends').set(scale.lo, scale.hi)
  uniform<Vector2>(material, 'shown').set(shown[0], shown[1])
  setUniform(material, 'logarithmic', scale.log)
}

/** Is there a selection, outside of which the surface steps back? */
export function setSelecting(material: ShaderMaterial, selecting: boolean): void {
  setUniform(material, 'selecting', selecting)
}

/** `colours` are CSS colours of the theme in force, by their uniforms. */
export function setNeutrals(material: ShaderMaterial, colours: Readonly<Record<string, string>>): void {
  for (const [name, css] of Object.entries(colours)) {
    const [r, g, b] = cssBytes(css)
    // Past three's colour management on purpose: the shader writes display values.
    const colour = uniform<Color>(material, name)
    colour.r = r / 255
    colour.g = g / 255
    colour.b = b / 255
  }
}

function uniform<T>(material: ShaderMaterial, name: string): T {
  const found = material.uniforms[name]
  if (!found) throw new Error(`the heatmap material has no uniform ${name}`)
  return found.value as T
}

function setUniform(material: ShaderMaterial, name: string, value: boolean): void {
  const found = material.uniforms[name]
  if (found) found.value = value
}

const known = new Map<string, [number, number, number]>()

/** Red, green and blue (0..255) of any colour that CSS can compute. */
export function cssBytes(css: string): [number, number, number] {
  const bytes = known.get(css) ?? read(css)
  known.set(css, bytes)
  return bytes
}

function read(css: string): [number, number, number] {
  // A canvas that the processor draws: to read another one, the page waits until the graphics card has drawn everything before.
  const context = document.createElement('canvas').getContext('2d', { willReadFrequently: true })
  if (!context) return [128, 128, 128]
  context.fillStyle = css
  context.fillRect(0, 0, 1, 1)
  const [r = 0, g = 0, b = 0] = context.getImageData(0, 0, 1, 1).data
  return [r, g, b]
}
