/** The secret that a link carries behind `#`, where no server and no log hears of it: of an invitation, or of an address. */
export function secretOf(hash: string, kind: 'invitation' | 'confirm'): string | null {
  const secret = new URLSearchParams(hash.replace(/^#/, '')).get(kind)
  return secret === null || secret.trim() === '' ? null : secret
}
