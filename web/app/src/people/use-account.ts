import { useQuery, useQueryClient } from '@tanstack/vue-query'
import { computed } from 'vue'
import { getAccount } from '../api/people'

/** Who is logged in, shared by all pages. */
export function useAccount() {
  const client = useQueryClient()
  const { data, isPending } = useQuery({ queryKey: ['account'], queryFn: getAccount, staleTime: 30_000 })
  return {
    account: computed(() => data.value?.account ?? null),
    isPending,
    /** After logging in or out everything may look different. */
    refresh: () => client.invalidateQueries(),
  }
}
