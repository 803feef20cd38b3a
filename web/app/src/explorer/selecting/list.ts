/** A named predicate; those that are on hold together. */
export interface NamedSelection {
  name: string
  where: string
  on: boolean
}

export const MOST_SELECTIONS = 12
const LONGEST_NAME = 40

/** The list as a link says it: `name:where;-name:where`, where the minus stands for "off". */
export function writeSelections(list: readonly NamedSelection[]): string {
  return list.map(({ name, where, on }) => `${on ? '' : '-'}${tidy(name)}:${where}`).join(';')
}

/** Reads such a list; nothing when it is none. */
export function readSelections(text: string): NamedSelection[] | undefined {
  const list = text.split(';').map((part) => {
    const [, off = '', name = '', where = ''] = /^(-?)([^:]*):(.+)$/.exec(part) ?? []
    return { name: tidy(name), where, on: off === '' }
  })
  return list.length <= MOST_SELECTIONS && list.every(({ where }) => where !== '') ? list : undefined
}

/** What holds of the configurations that all selections choose which are on; nothing when none is. */
export const whereOf = (list: readonly NamedSelection[]): string =>
  list.filter(({ on }) => on).map(({ where }) => `(${where})`).join(' & ')

/** A name without the signs that the link uses. */
export function tidy(name: string): string {
  return name.replace(/[:;]/g, ' ').replace(/^-+/, '').trim().slice(0, LONGEST_NAME)
}

const PLACE = 'Place'

/** The list with this place; a place that was brushed before gives way, since few points lie near both. */
export function placed(list: readonly NamedSelection[], where: string): NamedSelection[] {
  const place = { name: PLACE, where, on: true }
  if (list.some(({ name }) => name === PLACE)) return list.map((one) => (one.name === PLACE ? place : one))
  return list.length < MOST_SELECTIONS ? [...list, place] : [...list]
}

/** A name that no selection of the list has. */
export function freshName(list: readonly NamedSelection[], what: string): string {
  const taken = new Set(list.map(({ name }) => name))
  for (let i = 1; ; i++) if (!taken.has(`${what} ${i}`)) return `${what} ${i}`
}
