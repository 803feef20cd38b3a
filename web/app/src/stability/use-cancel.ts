import { useQueryClient } from '@tanstack/vue-query'
import { ref } from 'vue'
import { asApiError } from '../api/errors'
import { cancelStabilityRun } from '../api/stability'

/** Cancels stability runs of a list and reads the list again; `fault` says why one could not be cancelled. */
export function useCancel(list: string) {
  const cache = useQueryClient()
  const fault = ref<string | null>(null)
  async function cancel(id: string) {
    fault.value = null
    try {
      await cancelStabilityRun(id)
    } catch (thrown) {
      fault.value = asApiError(thrown).message
    }
    await cache.invalidateQueries({ queryKey: [list] })
  }
  return { cancel, fault }
}
