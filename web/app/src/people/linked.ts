const ID = '[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}'
const PATH = new RegExp(`(?<![\\w/])(/(?:r|campaigns)/${ID})(?![\\w/-])`)

/** A text in parts: what is the path of a run or a campaign leads there. */
export function linked(text: string): { text: string; to?: string }[] {
  return text
    .split(PATH)
    .map((part, i) => (i % 2 === 1 ? { text: part, to: part } : { text: part }))
    .filter(({ text: words }) => words !== '')
}
