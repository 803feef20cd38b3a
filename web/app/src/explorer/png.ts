import { inOneUnit } from '../ui/format'
import { colourAt, type Colormap } from './colormap'
import type { ColourScale } from './scale'
import { legendTicks } from './ticks'

/** What the picture says of itself. */
export interface PngLegend {
  title: string
  /** One line: on how many configurations, where, and what has no colour. */
  facts: string
  name: string
  unit: string
  scale: ColourScale
  colormap: Colormap
  /** Titles of the pictures, with their places in CSS pixels relative to the canvas. */
  panes: { title: string; x: number; y: number }[]
  /** CSS colours in force. */
  ink: string
  paper: string
}

const FOOT = 104
const PAD = 18
const FONT = 'system-ui, "DejaVu Sans", sans-serif'

/** The surface with its legend burned in, as PNG. */
export function heatmapPng(surface: HTMLCanvasElement, legend: PngLegend): Promise<Blob> {
  const ratio = surface.width / Math.max(1, surface.clientWidth)
  const width = surface.clientWidth
  const height = surface.clientHeight + FOOT
  const canvas = document.createElement('canvas')
  canvas.width = Math.round(width * ratio)
  canvas.height = Math.round(height * ratio)
  const context = canvas.getContext('2d')
  if (!context) return Promise.reject(new Error('This browser cannot draw the picture.'))
  context.scale(ratio, ratio)
  context.fillStyle = legend.paper
  context.fillRect(0, 0, width, height)
  context.drawImage(surface, 0, 0, width, surface.clientHeight)
  context.fillStyle = legend.ink
  for (const { title, x, y } of legend.panes) write(context, title, x + 12, y + 24, 600, 15)
  drawLegend(context, legend, width, surface.clientHeight)
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('This browser cannot write PNG.'))), 'image/png'),
  )
}

function drawLegend(context: CanvasRenderingContext2D, legend: PngLegend, width: number, top: number): void {
  const span = width - 2 * PAD
  const ticks = legendTicks(legend.scale)
  const labels = inOneUnit(ticks.map(({ value }) => value), legend.unit)
  write(context, `${legend.name}, ${labels.unit}${legend.scale.log ? ', logarithmic' : ''}`, PAD, top + 22, 600, 13)
  for (let i = 0; i < span; i++) {
    context.fillStyle = colourAt(legend.colormap, i / (span - 1))
    context.fillRect(PAD + i, top + 31, 1.5, 13)
  }
  context.fillStyle = legend.ink
  ticks.forEach(({ at }, i) => {
    context.textAlign = at < 0.05 ? 'left' : at > 0.95 ? 'right' : 'center'
    write(context, labels.texts[i] ?? '', PAD + at * span, top + 60, 400, 11.5)
  })
  context.textAlign = 'left'
  write(context, legend.title, PAD, top + 80, 600, 11.5)
  write(context, legend.facts, PAD, top + 96, 400, 11, span)
}

function write(
  context: CanvasRenderingContext2D, text: string, x: number, y: number, weight: number, size: number, most?: number,
): void {
  context.font = `${weight} ${size}px ${FONT}`
  context.fillText(text, x, y, most)
}
