import { computed, onScopeDispose, ref, watch } from 'vue'
import { useRoute, useRouter } from 'vue-router'
import { readState, writeState, type ExplorerState } from './url-state'

/** Browsers refuse a page that rewrites its address too often, so a slider's address waits until it rests. */
const PAUSE_MS = 300

/**
 * The state of the explorer, kept in the page's address: what the address says holds at first and after "back"; what
 * the reader changes is shown at once and written soon after.
 */
export function useLinkState() {
  const route = useRoute()
  const router = useRouter()
  const link = computed(() => readState(route.query))
  const state = ref<ExplorerState>(link.value.state)
  const text = (query: object) => JSON.stringify(Object.entries(query).toSorted())
  let written = text(route.query)
  let timer = 0

  watch(
    () => route.query,
    (query) => {
      if (text(query) === written) return
      written = text(query)
      state.value = link.value.state
    },
  )

  /** `quietly` changes (camera, sliders, the vertex that is read) make no step in the history. */
  function change(part: Partial<ExplorerState>, quietly = false) {
    state.value = { ...state.value, ...part }
    clearTimeout(timer)
    if (quietly) timer = window.setTimeout(() => write('replace'), PAUSE_MS)
    else write('push')
  }

  function write(how: 'push' | 'replace') {
    const query = writeState(state.value)
    written = text(query)
    void router[how]({ path: route.path, query })
  }

  onScopeDispose(() => clearTimeout(timer))
  return { state: computed(() => state.value), ignored: computed(() => link.value.ignored), change }
}
