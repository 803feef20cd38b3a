import { answer, http } from './client'
import type { Things } from './types'

/** Everything of one's own, or one thing of it with what goes with it. */
export type Which = { kind: 'all' } | { kind: 'run' | 'object'; id: string }

const of = (id: string) => ({ params: { path: { id } } })

export function thingsOf(which: Which): Promise<Things> {
  if (which.kind === 'run') return answer(http.GET('/api/v1/runs/{id}/things', of(which.id)))
  if (which.kind === 'object') return answer(http.GET('/api/v1/objects/{id}/things', of(which.id)))
  return answer(http.GET('/api/v1/things'))
}

/** Takes them away and gives what has gone. */
export function removeThings(which: Which): Promise<Things> {
  if (which.kind === 'run') return answer(http.DELETE('/api/v1/runs/{id}', of(which.id)))
  if (which.kind === 'object') return answer(http.DELETE('/api/v1/objects/{id}', of(which.id)))
  return answer(http.DELETE('/api/v1/things'))
}

export const keepLonger = (): Promise<Things> => answer(http.POST('/api/v1/things/keep'))
