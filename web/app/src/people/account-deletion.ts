import type { DeletionPreview } from '../api/types'
import { counted } from './owned'

/** What goes with an account, as a sentence. */
export function goesInWords({ goes }: Pick<DeletionPreview, 'goes'>): string {
  const things = counted(goes)
  const account = 'your password, sessions, tokens, address, choices and notices'
  return things === null ? `For good go ${account}.` : `For good go ${things}, and ${account}.`
}

/** What stays of it. */
export function staysInWords({ stays }: Pick<DeletionPreview, 'stays'>): string {
  const things = counted(stays)
  if (things === null) return 'Nothing of yours is public, so nothing stays. What should stay, make public first.'
  const written = stays.plugins > 0 ? ' What you wrote about a plugin when you sent it stays with it.' : ''
  return `Because it is public and may be cited, ${things} will stay, and name nobody.${written} What else should stay, make public first.`
}
