import { useInfiniteQuery, useQueryClient } from '@tanstack/vue-query'
import { computed, ref, type ComputedRef } from 'vue'
import { asApiError } from '../api/errors'
import { listNoticesFrom, readNotice, removeNotice } from '../api/people'
import type { AccountInfo } from '../api/types'

/** What the account was told, looked at every half minute as long as somebody is logged in. */
export function useNotices(account: ComputedRef<AccountInfo | null>) {
  const client = useQueryClient()
  // By account: who logs in here next sees nothing of it.
  const whose = computed(() => account.value?.id ?? null)
  const { data, hasNextPage, fetchNextPage } = useInfiniteQuery({
    queryKey: ['notices', whose],
    queryFn: ({ pageParam }) => listNoticesFrom(pageParam),
    initialPageParam: null as string | null,
    getNextPageParam: ({ next }) => next,
    refetchInterval: 30_000,
    enabled: computed(() => whose.value !== null),
  })
  const problem = ref('')
  const then = (work: (id: string) => Promise<unknown>) => async (id: string) => {
    problem.value = ''
    try {
      await work(id)
    } catch (thrown) {
      problem.value = asApiError(thrown).message
    }
    // Also when it was gone already: then the list is old.
    await client.invalidateQueries({ queryKey: ['notices'] })
  }
  return {
    notices: computed(() => (whose.value === null ? [] : (data.value?.pages.flatMap(({ entries }) => entries) ?? []))),
    problem,
    more: hasNextPage,
    older: () => fetchNextPage(),
    read: then(readNotice),
    remove: then(removeNotice),
  }
}
