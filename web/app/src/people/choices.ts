import type { Choices } from '../api/types'

/** Where the mails of an account go, as a sentence. */
export function whereMailsGo({ address, confirmed, mail_notices: wanted, mailing }: Choices): string {
  if (!mailing) return 'This service sends no mails; notices are on the page of your runs.'
  if (address == null) return 'No address yet: nothing is mailed.'
  if (!confirmed) return `A mail with a link went to ${address}, unless it was asked for too often. Until that link is opened, nothing else goes there.`
  return wanted ? `Notices go to ${address}.` : `${address} is confirmed; nothing goes there as long as you want no mails.`
}
