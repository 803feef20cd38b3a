import type { DeletionPreview } from '../api/types'
import { counted } from './owned'

/** What goes with an account, as a sentence. */
export function goesInWords({ goes }: Pick<DeletionPreview, 'goes'>): string {
  const things = counted(goes)
  const account = 'your password, sessions, tokens, address, choices and notices'
  return things === null ? `This permanently deletes ${account}.` : `This permanently deletes ${things}, and ${account}.`
}

/** What stays of it. */
export function staysInWords({ stays }: Pick<DeletionPreview, 'stays'>): string {
  const things = counted(stays)
  if (things === null) return 'Nothing of yours is public, so nothing stays. To keep something, make it public first.'
  const written = stays.plugins > 0 ? ' A plugin keeps the manifest that you submitted with it.' : ''
  return `${things} will stay, without your name: public items may be cited.${written} To keep other items, make them public first.`
}
