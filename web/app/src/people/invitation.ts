/** The secret of an invitation in the part of an address behind `#`, or nothing. */
export function secretOf(hash: string): string | null {
  const secret = new URLSearchParams(hash.replace(/^#/, '')).get('invitation')
  return secret === null || secret.trim() === '' ? null : secret
}
