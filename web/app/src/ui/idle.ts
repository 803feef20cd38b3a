/** When the page has nothing urgent to do, or after half a second. */
export function whenIdle(): Promise<void> {
  return new Promise((now) => {
    // Safari has no idle callbacks.
    if ('requestIdleCallback' in window) requestIdleCallback(() => now(), { timeout: 500 })
    else setTimeout(now, 50)
  })
}
