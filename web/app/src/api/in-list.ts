import type { QueryClient } from '@tanstack/vue-query'

/** Puts something new into a list, at once and again behind an answer that was under way, which lacks it. */
export async function putInList<T>(cache: QueryClient, list: string, put: (old: T[]) => T[]): Promise<void> {
  const queryKey = [list]
  const now = () => cache.setQueryData<T[]>(queryKey, (old = []) => put(old))
  now()
  if (cache.isFetching({ queryKey }) === 0) return
  await cache.refetchQueries({ queryKey }, { cancelRefetch: false })
  now()
}
