/** What a stroke does; places are client coordinates. */
export interface StrokeEvents {
  /** Whether a stroke may begin there. */
  begin: (x: number, y: number) => boolean
  grow: (x: number, y: number) => void
  /** The pointer was lifted, or (not `kept`) taken away. */
  end: (kept: boolean) => void
}

/** Dragging with Shift, which then does not move the camera. Answers how to stop listening. */
export function strokes(element: HTMLElement, events: StrokeEvents): () => void {
  const abort = new AbortController()
  const { signal } = abort
  let pointer: number | null = null
  // Before the camera's own listeners on the same element.
  const take = (event: PointerEvent) => {
    event.stopPropagation()
    event.preventDefault()
  }
  element.addEventListener('pointerdown', (event) => {
    if (!event.shiftKey || event.button !== 0 || pointer !== null || !events.begin(event.clientX, event.clientY)) return
    pointer = event.pointerId
    element.setPointerCapture(pointer)
    take(event)
  }, { signal, capture: true })
  element.addEventListener('pointermove', (event) => {
    if (event.pointerId !== pointer) return
    events.grow(event.clientX, event.clientY)
    take(event)
  }, { signal, capture: true })
  for (const kind of ['pointerup', 'pointercancel'] as const) {
    element.addEventListener(kind, (event) => {
      if (event.pointerId !== pointer) return
      pointer = null
      events.end(kind === 'pointerup')
      take(event)
    }, { signal, capture: true })
  }
  return () => abort.abort()
}
