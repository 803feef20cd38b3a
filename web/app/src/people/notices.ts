import type { NoticeInfo } from '../api/types'

/** What is new, and what was read before; each newest first, as it came. */
export function byReading(notices: NoticeInfo[]): { unread: NoticeInfo[]; read: NoticeInfo[] } {
  return { unread: notices.filter((one) => one.read_us == null), read: notices.filter((one) => one.read_us != null) }
}
