import type { Choices } from '../api/types'

/** Where the mails of an account go, as a sentence. */
export function whereMailsGo({ address, confirmed, mail_notices: wanted, mailing }: Choices): string {
  if (!mailing) return 'This service sends no mails; notices appear above your runs.'
  if (address == null) return 'No address is set, so no mails are sent.'
  if (!confirmed) return `A confirmation link was sent to ${address}, unless it was requested too often. Until the link is opened, no other mail is sent there.`
  return wanted ? `Notices go to ${address}.` : `${address} is confirmed; mails are off.`
}
