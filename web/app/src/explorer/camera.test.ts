import { PerspectiveCamera, Sphere, Vector3 } from 'three'
import { expect, test, vi } from 'vitest'
import { CameraRig } from './camera'

/** A rig that looks at the unit sphere, and what a finger at these coordinates tells it. */
function rig() {
  const element = document.createElement('div')
  Object.defineProperties(element, { clientHeight: { value: 300 }, clientWidth: { value: 300 } })
  Object.assign(element, { setPointerCapture: () => {}, releasePointerCapture: () => {} })
  document.body.append(element)
  const events = { moved: vi.fn<() => void>(), rested: vi.fn<(view: number[]) => void>(), clicked: vi.fn<(x: number, y: number) => void>() }
  const made = new CameraRig(new PerspectiveCamera(), element, events)
  made.fit(new Sphere(new Vector3(), 1))
  const finger = (type: string, y: number) => {
    const event = new PointerEvent(type, { pointerId: 1, pointerType: 'touch', isPrimary: true, bubbles: true, clientX: 100, clientY: y })
    element.dispatchEvent(Object.defineProperties(event, { pageX: { value: 100 }, pageY: { value: y } }))
  }
  return { made, events, finger }
}

test('a finger turns the object, and a swipe that the browser takes for scrolling does not', () => {
  vi.useFakeTimers()
  const { made, events, finger } = rig()
  const start = made.view()
  finger('pointerdown', 100)
  finger('pointermove', 76)
  expect(made.view()).not.toEqual(start)
  finger('pointercancel', 76)
  vi.runAllTimers()
  expect(made.view()).toEqual(start)
  expect(events.rested).not.toHaveBeenCalled()
  finger('pointerdown', 100)
  finger('pointermove', 76)
  finger('pointerup', 76)
  vi.runAllTimers()
  expect(events.rested).toHaveBeenCalledWith(made.view())
  expect(made.view()).not.toEqual(start)
  made.dispose()
  vi.useRealTimers()
})
