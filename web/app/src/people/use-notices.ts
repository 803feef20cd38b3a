import { useInfiniteQuery, useQueryClient } from '@tanstack/vue-query'
import { computed, type ComputedRef } from 'vue'
import { listNoticesFrom, readNotice, removeNotice } from '../api/people'

/** What the account was told, looked at every half minute as long as somebody is logged in. */
export function useNotices(loggedIn: ComputedRef<boolean>) {
  const client = useQueryClient()
  const { data, hasNextPage, fetchNextPage } = useInfiniteQuery({
    queryKey: ['notices'],
    queryFn: ({ pageParam }) => listNoticesFrom(pageParam),
    initialPageParam: null as string | null,
    getNextPageParam: ({ next }) => next,
    refetchInterval: 30_000,
    enabled: loggedIn,
  })
  const then = (work: (id: string) => Promise<unknown>) => async (id: string) => {
    try {
      await work(id)
    } finally {
      // Also when it was gone already: then the list is old.
      await client.invalidateQueries({ queryKey: ['notices'] })
    }
  }
  return {
    notices: computed(() => (loggedIn.value ? (data.value?.pages.flatMap(({ entries }) => entries) ?? []) : [])),
    more: hasNextPage,
    older: () => fetchNextPage(),
    read: then(readNotice),
    remove: then(removeNotice),
  }
}
