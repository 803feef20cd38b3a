import { computed, onScopeDispose, ref, shallowRef, watch, type ComputedRef } from 'vue'
import { getSelection } from '../../api/client'
import type { RunInfo } from '../../api/types'
import { loadSurface, originOf } from '../surface'
import type { ExplorerState } from '../url-state'
import { measured } from '../use-run-data'
import type { Answer, Question, SurfaceData } from './engine'
import type { Message, Reply } from './worker'

/** Cells of the chart: two pixels each at its usual size, larger where single points would be lost. */
const cells = (configurations: number): [number, number] => (configurations > 5000 ? [170, 110] : [85, 55])

/**
 * The configurations behind the pictures: what the selections hold, for chart, surface and table. The service says which
 * configurations each selects, and a worker counts, so the page stays fluent; only the newest question counts.
 */
export function useSelection(run: ComputedRef<RunInfo>, state: ComputedRef<ExplorerState>, lookedAt: ComputedRef<string | null>) {
  const answer = shallowRef<Answer | null>(null)
  const error = ref<string | null>(null)
  const across = ref<string | null>(null)
  let worker: Worker | null = null
  let ready: Promise<void> | null = null
  let newest = 0

  function open(): Promise<void> {
    const { id, spec } = run.value
    worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' })
    worker.addEventListener('message', ({ data }: MessageEvent<Reply>) => {
      if (data.number !== newest) return
      performance.measure('selection', { start: `selection-${data.number}` })
      error.value = 'error' in data ? data.error : null
      if ('answer' in data) answer.value = data.answer
    })
    const send = (message: Message) => worker?.postMessage(message, [])
    return (async () => {
      const a = await surfaceData(spec.object_a)
      const b = spec.object_b && spec.object_b !== spec.object_a ? await surfaceData(spec.object_b) : a
      send({ kind: 'open', run: id, a, b })
    })()
  }

  const question = computed<Question | null>(() =>
    lookedAt.value === null
      ? null
      : {
          where: state.value.selections.filter(({ on }) => on).map(({ where }) => where),
          lookedAt: lookedAt.value,
          side: state.value.side,
          points: state.value.points,
          y: across.value,
          cells: cells(run.value.set?.configurations ?? 0),
          algorithms: measured(run.value).map(({ id }) => id),
        },
  )
  const key = computed(() => JSON.stringify(question.value))

  async function ask() {
    if (!question.value) return
    try {
      await (ready ??= open())
      newest++
      performance.mark(`selection-${newest}`)
      const message: Message = { kind: 'ask', number: newest, question: question.value }
      worker?.postMessage(message, [])
    } catch (thrown) {
      ready = null
      error.value = thrown instanceof Error ? thrown.message : String(thrown)
    }
  }
  /** The text of a selection as the service reads it, or an error that says what is wrong with it. */
  const read = async (where: string): Promise<string> =>
    (await getSelection(run.value.id, { algorithm: lookedAt.value ?? '', where })).where
  watch(key, () => void ask(), { immediate: true })
  onScopeDispose(() => worker?.terminate())
  return { answer, error, across, read }
}

async function surfaceData(object: string): Promise<SurfaceData> {
  const geometry = await loadSurface(object)
  const positions = geometry.getAttribute('position').array as Float32Array
  const corners = geometry.index?.array as Uint32Array
  geometry.computeBoundingBox()
  const box = geometry.boundingBox
  const longest = box ? Math.max(box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z) : 1
  return { positions, corners, longest, origin: originOf(geometry) }
}
