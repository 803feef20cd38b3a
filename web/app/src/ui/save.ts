/** Hands a file made in the browser to the reader. */
export function save(content: Blob, name: string): void {
  const link = document.createElement('a')
  link.href = URL.createObjectURL(content)
  link.download = name
  link.click()
  // The download has its own reference once it has begun.
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000)
}

/** A name without what file systems dislike. */
export function fileName(...parts: string[]): string {
  return parts.map((part) => part.replace(/[^\w.@-]+/g, '-')).join('_')
}
