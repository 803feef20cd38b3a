import { interpolateCividis, interpolatePuOr, interpolateTurbo, interpolateViridis } from 'd3-scale-chromatic'

export const COLORMAPS = ['turbo', 'viridis', 'cividis'] as const
/** The map of differences: purple below 0, white at 0, orange above; told apart with colour vision deficiency, too. */
export const DIVERGING = 'purple_orange'
export type Colormap = (typeof COLORMAPS)[number] | typeof DIVERGING

const INTERPOLATE: Record<Colormap, (t: number) => string> = {
  turbo: interpolateTurbo,
  viridis: interpolateViridis,
  cividis: interpolateCividis,
  purple_orange: interpolatePuOr,
}

/** Entries of the lookup table that the shader reads. */
export const LUT_SIZE = 256

/** The colour map as 256 RGBA texels (sRGB bytes, opaque), low end first. */
export function lut(name: Colormap): Uint8Array<ArrayBuffer> {
  const texels = new Uint8Array(LUT_SIZE * 4)
  for (let i = 0; i < LUT_SIZE; i++) {
    texels.set(rgb(INTERPOLATE[name](i / (LUT_SIZE - 1))), i * 4)
    texels[i * 4 + 3] = 255
  }
  return texels
}

/** The same map for CSS, left to right. */
export function cssGradient(name: Colormap, direction = 'to right'): string {
  const stops = Array.from({ length: 17 }, (_, i) => INTERPOLATE[name](i / 16))
  return `linear-gradient(${direction}, ${stops.join(', ')})`
}

/** CSS colour at a position between 0 and 1. */
export function colourAt(name: Colormap, position: number): string {
  return INTERPOLATE[name](Math.min(1, Math.max(0, position)))
}

/** d3 answers `#rrggbb` for viridis and `rgb(r, g, b)` for the other two. */
function rgb(css: string): [number, number, number] {
  if (css.startsWith('#')) {
    const value = Number.parseInt(css.slice(1), 16)
    return [(value >> 16) & 255, (value >> 8) & 255, value & 255]
  }
  const [r = 0, g = 0, b = 0] = (css.match(/[\d.]+/g) ?? []).map(Number)
  return [Math.round(r), Math.round(g), Math.round(b)]
}
