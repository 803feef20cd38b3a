import { onScopeDispose, ref, shallowRef, watch, type Ref } from 'vue'
import { getRun } from '../api/client'
import { asApiError } from '../api/errors'
import { applyEvent, hasEnded, RunStream, type Connection } from '../api/run-stream'
import type { RunInfo } from '../api/types'
import { takeStarted } from './just-started'

/** A run that keeps itself up to date until it has ended. */
export function useRun(id: Ref<string | null>) {
  const run = shallowRef<RunInfo | null>(null)
  const error = ref<string | null>(null)
  const connection = ref<Connection>('live')
  /** When something was last heard, milliseconds since the epoch. */
  const heard = ref(Date.now())
  let stream: RunStream | null = null

  async function fetchRun(wanted: string) {
    try {
      const fresh = await getRun(wanted)
      if (wanted !== id.value) return
      run.value = fresh
      heard.value = Date.now()
      error.value = null
      if (hasEnded(fresh.state)) stop()
      else follow(wanted)
    } catch (thrown) {
      // While a run is on the screen a failed poll only shows in the connection's state.
      if (wanted === id.value && !run.value) error.value = asApiError(thrown).message
    }
  }

  function follow(wanted: string) {
    stream ??= new RunStream(wanted, {
      event: (event) => {
        heard.value = Date.now()
        if (!run.value || wanted !== id.value) return
        run.value = applyEvent(run.value, event)
        // The end brings what no event holds: the set, the machine, the message.
        if (hasEnded(event.state)) void fetchRun(wanted)
      },
      connection: (state) => (connection.value = state),
      poll: () => void fetchRun(wanted),
    })
  }

  function stop() {
    stream?.close()
    stream = null
  }

  watch(
    id,
    (wanted) => {
      stop()
      run.value = wanted ? takeStarted(wanted) : null
      error.value = null
      if (wanted && run.value) follow(wanted)
      else if (wanted) void fetchRun(wanted)
    },
    { immediate: true },
  )
  onScopeDispose(stop)
  return { run, error, connection, heard, refresh: () => (id.value ? fetchRun(id.value) : Promise.resolve()) }
}
