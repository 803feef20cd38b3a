import { scaleLinear, scaleLog, type ScaleLinear, type ScaleLogarithmic } from 'd3-scale'
import { curveStepAfter, line } from 'd3-shape'
import type { Ecdf } from '../api/types'
import { count } from '../ui/format'
import { logTicks } from '../explorer/ticks'

export interface Axes {
  x: ScaleLogarithmic<number, number>
  y: ScaleLinear<number, number>
}

/** Scales that hold all curves: time on a logarithmic axis over whole decades' parts, share from 0 to 1. */
export function ecdfAxes(curves: readonly Ecdf[], box: { left: number; right: number; top: number; bottom: number }): Axes {
  const times = curves.flatMap((curve) => curve.time_ns.filter((t) => t > 0))
  const lo = Math.min(...times)
  const hi = Math.max(...times)
  const domain: [number, number] = times.length === 0 ? [1, 10] : [lo / 1.15, hi * 1.15]
  return {
    x: scaleLog(domain, [box.left, box.right]),
    y: scaleLinear([0, 1], [box.bottom, box.top]),
  }
}

/** The curve as an SVG path: a staircase from 0 at its first time to 1 at its last. */
export function ecdfPath(curve: Ecdf, { x, y }: Axes): string {
  const points: [number, number][] = []
  curve.time_ns.forEach((t, i) => {
    const share = curve.share[i]
    if (t > 0 && share !== undefined) points.push([x(t), y(share)])
  })
  const [first] = points
  if (!first) return ''
  const path = line<[number, number]>(([px]) => round(px), ([, py]) => round(py)).curve(curveStepAfter)
  return path([[first[0], y(0)], ...points]) ?? ''
}

/** The time below which a share of the queries lies. */
export function timeAtShare(curve: Ecdf, share: number): number | null {
  const at = curve.share.findIndex((value) => value >= share)
  return curve.time_ns[at] ?? null
}

/**
 * How far the shares of preliminary curves may lie from those of all configurations: with 95 % certainty a whole curve lies
 * within this band (P. Massart, The tight constant in the Dvoretzky-Kiefer-Wolfowitz inequality, 1990). Null when none is preliminary.
 */
export function preliminaryWords(curves: readonly Ecdf[]): string | null {
  const all = curves.filter(({ preliminary, n }) => preliminary && n > 0).map(({ n }) => n)
  if (all.length === 0) return null
  const [least, most] = [Math.min(...all), Math.max(...all)]
  const n = least === most ? count(least) : `${count(least)} to ${count(most)}`
  const band = (100 * Math.sqrt(Math.log(2 / 0.05) / (2 * least))).toPrecision(2)
  return `preliminary, n = ${n}, shares ± ${band} % (95 %)`
}

/** Round times on the axis. */
export function timeTicks({ x }: Axes): number[] {
  const [lo = 1, hi = 10] = x.domain()
  return logTicks(lo, hi, 8)
}

function round(n: number): number {
  return Math.round(n * 10) / 10
}
