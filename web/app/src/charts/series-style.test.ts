import { readFileSync } from 'node:fs'
import { describe, expect, it } from 'vitest'
import { seriesStyle } from './series-style'

type Vector = readonly number[]
const times = (matrix: readonly Vector[], v: Vector) => matrix.map((row) => row.reduce((sum, m, i) => sum + m * (v[i] ?? 0), 0))

/** What is left of a colour (linear RGB) where one kind of cone is missing: Machado, Oliveira and Fernandes (2009), severity 1. */
const VISION: Record<string, readonly Vector[]> = {
  full: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
}

const linear = (hex: string) =>
  [1, 3, 5].map((at) => {
    const c = Number.parseInt(hex.slice(at, at + 2), 16) / 255
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4
  })

/** CIE L*a*b* (D65) of linear RGB. */
function lab(rgb: Vector): Vector {
  const xyz = times([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]], rgb)
  const [x = 0, y = 0, z = 0] = xyz.map((value, i) => value / ([0.9505, 1, 1.089][i] ?? 1)).map((t) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116))
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)]
}

const tokens = readFileSync(new URL('../style/tokens.css', `file://${__filename}`), 'utf8')
/** A colour of the pages in both themes. */
function token(name: string): [string, string] {
  const [, light = '', dark = ''] = new RegExp(`--${name}: light-dark\\((#\\w+), (#\\w+)\\)`).exec(tokens) ?? []
  return [light, dark]
}
const luminance = (hex: string) => times([[0.2126, 0.7152, 0.0722]], linear(hex))[0] ?? 0
const contrast = (a: string, b: string) => {
  const [hi = 1, lo = 0] = [luminance(a), luminance(b)].toSorted((x, y) => y - x)
  return (hi + 0.05) / (lo + 0.05)
}

const styles = Array.from({ length: 8 }, (_, i) => seriesStyle(i))
const pairs = styles.flatMap((a, i) => styles.slice(i + 1).map((b) => [a, b] as const))

describe('the eight styles of series and families', () => {
  it('are told apart by mark and by dash, each alone', () => {
    for (const [a, b] of pairs) {
      expect(a.marker).not.toBe(b.marker)
      expect(a.dash).not.toBe(b.dash)
    }
  })

  it.each(Object.keys(VISION))('have colours that stay apart with %s, in both themes', (vision) => {
    for (const theme of [0, 1]) {
      const seen = [0, 1, 2, 3].map((i) => times(VISION[vision] ?? [], linear(token(`series-${i}`)[theme] ?? '')).map((c) => Math.min(1, Math.max(0, c))))
      const colours = seen.map(lab)
      colours.forEach((a, i) =>
        colours.slice(i + 1).forEach((b) => {
          // Some 2.3 are just noticed when side by side; marks lie apart, so several times that.
          expect(Math.hypot(...a.map((value, k) => value - (b[k] ?? 0)))).toBeGreaterThan(10)
        }),
      )
    }
  })

  it('stand out from the sheet', () => {
    for (const theme of [0, 1]) for (const i of [0, 1, 2, 3]) expect(contrast(token(`series-${i}`)[theme] ?? '', token('sheet')[theme] ?? '')).toBeGreaterThan(4.5)
  })
})
