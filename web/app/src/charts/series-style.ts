/** How the n-th algorithm is drawn in a chart: told apart by colour, dash and marker, each alone enough. */
export interface SeriesStyle {
  colour: string
  dash: string
  /** Path of a marker around 0,0, about 9 units wide. */
  marker: string
  name: string
}

const STYLES: readonly SeriesStyle[] = [
  { colour: 'var(--series-0)', dash: '', marker: 'M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0Z', name: 'solid line, circle' },
  { colour: 'var(--series-1)', dash: '8 4', marker: 'M-4-4h8v8h-8Z', name: 'dashed line, square' },
  { colour: 'var(--series-2)', dash: '2 4', marker: 'M0-5 5 4h-10Z', name: 'dotted line, triangle' },
  { colour: 'var(--series-3)', dash: '9 3 2 3', marker: 'M0-5.5 5.5 0 0 5.5-5.5 0Z', name: 'dash-dotted line, diamond' },
]

export function seriesStyle(index: number): SeriesStyle {
  const style = STYLES[index % STYLES.length]
  if (!style) throw new Error('there is at least one style')
  return style
}
