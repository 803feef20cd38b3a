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
  { colour: 'var(--series-0)', dash: '14 4', marker: 'M0 5-5-4h10Z', name: 'long dashes, triangle upside down' },
  { colour: 'var(--series-1)', dash: '4 2', marker: 'M-1.5-5h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5v-3h3.5Z', name: 'short dashes, plus' },
  { colour: 'var(--series-2)', dash: '12 3 2 3 2 3', marker: 'M-5-5h10l-3 5 3 5h-10l3-5Z', name: 'dash and two dots, hourglass' },
  { colour: 'var(--series-3)', dash: '1 3', marker: 'M0-5.5 5-1v5.5h-10V-1Z', name: 'fine dots, house' },
]

export function seriesStyle(index: number): SeriesStyle {
  const style = STYLES[index % STYLES.length]
  if (!style) throw new Error('there is at least one style')
  return style
}
