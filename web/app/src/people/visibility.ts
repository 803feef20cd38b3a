import type { Visibility } from '../api/types'

/** Who sees something, in words; the narrowest first. */
export const VISIBILITY: Record<Visibility, string> = {
  private: 'only you',
  unlisted: 'anyone with the link',
  public: 'everyone',
}
