import { useInfiniteQuery } from '@tanstack/vue-query'
import { computed, type MaybeRefOrGetter, toValue } from 'vue'
import type { Part } from '../api/client'
import type { PluginInfo } from '../api/types'

/** A list of plugins, part by part, looked at every ten seconds as long as it is `wanted`. */
export function usePluginList(name: string, load: (cursor: string | null) => Promise<Part<PluginInfo>>, wanted: MaybeRefOrGetter<boolean> = true) {
  const { data, error, isPending, hasNextPage, isFetchingNextPage, fetchNextPage } = useInfiniteQuery({
    queryKey: [name],
    queryFn: ({ pageParam }) => load(pageParam),
    initialPageParam: null as string | null,
    getNextPageParam: ({ next }) => next,
    refetchInterval: 10_000,
    enabled: computed(() => toValue(wanted)),
  })
  return {
    plugins: computed(() => data.value?.pages.flatMap(({ entries }) => entries) ?? []),
    error,
    isPending,
    more: hasNextPage,
    busy: isFetchingNextPage,
    goOn: () => fetchNextPage(),
  }
}
