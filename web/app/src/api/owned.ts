import { answer, http } from './client'
import type { OwnedItems } from './types'

/** Everything of one's own, or one thing of it with what goes with it. */
export type Which = { kind: 'all' } | { kind: 'run' | 'object' | 'configurations'; id: string }

const of = (id: string) => ({ params: { path: { id } } })

export function ownedItems(which: Which): Promise<OwnedItems> {
  if (which.kind === 'run') return answer(http.GET('/api/v1/runs/{id}/deletion-preview', of(which.id)))
  if (which.kind === 'object') return answer(http.GET('/api/v1/objects/{id}/deletion-preview', of(which.id)))
  if (which.kind === 'configurations') return answer(http.GET('/api/v1/configurations/{id}/deletion-preview', of(which.id)))
  return answer(http.GET('/api/v1/data'))
}

/** Takes them away and gives what has gone. */
export function deleteOwned(which: Which): Promise<OwnedItems> {
  if (which.kind === 'run') return answer(http.DELETE('/api/v1/runs/{id}', of(which.id)))
  if (which.kind === 'object') return answer(http.DELETE('/api/v1/objects/{id}', of(which.id)))
  if (which.kind === 'configurations') return answer(http.DELETE('/api/v1/configurations/{id}', of(which.id)))
  return answer(http.DELETE('/api/v1/data'))
}

export const keepLonger = (): Promise<OwnedItems> => answer(http.POST('/api/v1/data/keep'))
