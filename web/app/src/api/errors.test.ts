import { expect, it } from 'vitest'
import { asApiError, fromResponse } from './errors'

it('says what the problem document says', () => {
  const problem = { type: 'about:blank', title: 'Invalid object', status: 422, detail: 'Line 3: "nan" is no number.' }
  expect(fromResponse(422, problem).message).toBe('Line 3: "nan" is no number.')
  expect(fromResponse(422, { title: 'Invalid object' }).message).toBe('Invalid object')
})

it('has a sentence of its own for answers without one', () => {
  expect(fromResponse(404, null).message).toBe('There is nothing at this address.')
  expect(fromResponse(500, 'oops').message).toContain('status 500')
})

it('knows what may pass by itself', () => {
  expect(asApiError(new TypeError('Failed to fetch')).passing).toBe(true)
  expect(asApiError(new TypeError('Failed to fetch')).message).toContain('does not answer')
  expect(fromResponse(503, null).passing).toBe(true)
  expect(fromResponse(422, null).passing).toBe(false)
})
