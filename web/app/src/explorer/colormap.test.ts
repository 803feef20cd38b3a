import { describe, expect, it } from 'vitest'
import { COLORMAPS, colourAt, cssGradient, DIVERGING, lut, LUT_SIZE } from './colormap'

const texel = (table: Uint8Array, i: number) => [...table.subarray(i * 4, i * 4 + 4)]

describe('lut', () => {
  it('begins and ends with the published colours', () => {
    // From the maps' own papers and tables (turbo: its polynomial's ends).
    expect(texel(lut('viridis'), 0)).toEqual([68, 1, 84, 255])
    expect(texel(lut('viridis'), LUT_SIZE - 1)).toEqual([253, 231, 37, 255])
    expect(texel(lut('cividis'), 0)).toEqual([0, 32, 81, 255])
    expect(texel(lut('turbo'), 0)).toEqual([35, 23, 27, 255])
  })

  it('draws differences purple below 0 and orange above, as the exported files do', () => {
    const [low, high] = [texel(lut(DIVERGING), 0), texel(lut(DIVERGING), LUT_SIZE - 1)]
    expect(low[2]).toBeGreaterThan(low[0] ?? 255)
    expect(high[0]).toBeGreaterThan(high[2] ?? 255)
  })

  it.each(COLORMAPS)('%s gives the shader the colours that the legend shows', (name) => {
    const table = lut(name)
    const [r = 0, g = 0, b = 0] = texel(table, 128)
    const css = colourAt(name, 128 / 255)
    const legend = css.startsWith('#')
      ? [1, 3, 5].map((at) => Number.parseInt(css.slice(at, at + 2), 16))
      : (css.match(/\d+/g) ?? []).map(Number)
    expect([r, g, b]).toEqual(legend)
    expect(table).toHaveLength(LUT_SIZE * 4)
  })

  it('holds values beyond the ends at the ends', () => {
    expect(colourAt('viridis', 7)).toBe(colourAt('viridis', 1))
    expect(cssGradient('viridis')).toMatch(/^linear-gradient\(to right, #440154, .*#fde725\)$/)
  })
})
