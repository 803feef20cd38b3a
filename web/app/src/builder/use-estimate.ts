import { onScopeDispose, ref, watch, type Ref } from 'vue'
import { estimate } from '../api/client'
import { asApiError } from '../api/errors'
import type { Estimate, RunSpec } from '../api/types'

/** Long enough for a digit to be typed, short enough to feel immediate. */
const PAUSE_MS = 350

/** What a run would cost, asked anew after each change; the last answer wins. */
export function useEstimate(spec: Ref<RunSpec | null>) {
  const answer = ref<Estimate | null>(null)
  const error = ref<string | null>(null)
  const asking = ref(false)
  let timer = 0
  let running: AbortController | null = null

  watch(
    () => JSON.stringify(spec.value),
    () => {
      clearTimeout(timer)
      running?.abort()
      error.value = null
      const wanted = spec.value
      asking.value = wanted !== null
      if (!wanted) {
        answer.value = null
        return
      }
      timer = window.setTimeout(() => void ask(wanted), PAUSE_MS)
    },
    { immediate: true },
  )

  async function ask(wanted: RunSpec) {
    const mine = (running = new AbortController())
    try {
      const found = await estimate(wanted, mine.signal)
      if (!mine.signal.aborted) answer.value = found
    } catch (thrown) {
      if (mine.signal.aborted) return
      answer.value = null
      error.value = asApiError(thrown).message
    } finally {
      if (!mine.signal.aborted) asking.value = false
    }
  }

  onScopeDispose(() => {
    clearTimeout(timer)
    running?.abort()
  })
  return { answer, error, asking }
}
