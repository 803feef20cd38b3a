/** The cursor in the header that says where a list goes on (`<...?cursor=...>; rel="next"`); null at its end. */
export function nextOf(link: string | null): string | null {
  const address = /<([^>]*)>\s*;\s*rel="next"/.exec(link ?? '')?.[1]
  if (address === undefined) return null
  return new URLSearchParams(address.split('?')[1] ?? '').get('cursor')
}
