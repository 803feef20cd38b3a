/** Properties that a stylesheet gives and a file of its own must carry. */
const CARRIED = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'font-family', 'font-size', 'text-anchor'] as const

const DRAWN: ReadonlySet<string> = new Set(['path', 'line', 'text', 'tspan', 'rect', 'circle'])

/** The chart as a file of its own: computed styles written into each element, text kept as text. */
export function standaloneSvg(svg: SVGSVGElement): string {
  const copy = svg.cloneNode(true) as SVGSVGElement
  const originals = [svg, ...svg.querySelectorAll('*')]
  const copies = [copy, ...copy.querySelectorAll('*')]
  originals.forEach((original, i) => {
    const style = getComputedStyle(original)
    const target = copies[i]
    if (!target) return
    const scope = [...target.attributes].filter(({ name }) => name.startsWith('data-v-'))
    for (const { name } of scope) target.removeAttribute(name)
    for (const name of DRAWN.has(target.tagName) ? CARRIED : []) {
      const value = style.getPropertyValue(name)
      if (value) target.setAttribute(name, value)
    }
    target.removeAttribute('class')
    target.removeAttribute('style')
  })
  const { width, height } = svg.viewBox.baseVal
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg')
  copy.setAttribute('width', String(width))
  copy.setAttribute('height', String(height))
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`
}
