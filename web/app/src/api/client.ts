import createClient from 'openapi-fetch'
import { asApiError, fromResponse } from './errors'
import { nextOf } from './link'
import type { paths } from './schema'
import type {
  Accuracy, AdviceInfo, AdviceSpec, AlgorithmInfo, Board, Chart, ChartKind, Citation, Ecdf, Estimate, ExampleInfo, Heatmap, HeatmapRequest, Meeting, ObjectInfo, RunInfo, RunSpec, Selected, Status, SuiteInfo, Visibility, WorstCase,
} from './types'

export const http = createClient<paths>({ baseUrl: '/' })

/** Unwraps an answer; anything but success becomes an `ApiError` with one sentence. */
export async function answer<T>(call: Promise<{ data?: T; error?: unknown; response: Response }>): Promise<T> {
  try {
    const { data, error, response } = await call
    if (!response.ok || data === undefined) throw fromResponse(response.status, error)
    return data
  } catch (thrown) {
    throw asApiError(thrown)
  }
}

/** As `answer`, where success says nothing more. */
export async function nothing(call: Promise<{ error?: unknown; response: Response }>): Promise<void> {
  try {
    const { error, response } = await call
    if (!response.ok) throw fromResponse(response.status, error)
  } catch (thrown) {
    throw asApiError(thrown)
  }
}

/** A part of a list, and where it goes on. */
export interface Part<T> {
  entries: T[]
  next: string | null
}

/** As `answer`, for a part of a list. */
export async function part<T>(call: Promise<{ data?: T[]; error?: unknown; response: Response }>): Promise<Part<T>> {
  const entries = await answer(call)
  const { response } = await call
  return { entries, next: nextOf(response.headers.get('link')) }
}

/** A whole list, part by part. */
export async function whole<T>(load: (query: { cursor?: string }) => Promise<Part<T>>): Promise<T[]> {
  const all: T[] = []
  let cursor: string | null = null
  do {
    const { entries, next }: Part<T> = await load(cursor === null ? {} : { cursor })
    all.push(...entries)
    cursor = next
  } while (cursor !== null)
  return all
}

export const listObjects = (): Promise<ObjectInfo[]> =>
  whole((query) => part(http.GET('/api/v1/objects', { params: { query } })))

export const listAlgorithms = (): Promise<AlgorithmInfo[]> => answer(http.GET('/api/v1/algorithms'))

export const estimate = (spec: RunSpec, signal?: AbortSignal): Promise<Estimate> =>
  answer(http.POST('/api/v1/estimates', { body: spec, ...(signal && { signal }) }))

export const startRun = (spec: RunSpec): Promise<RunInfo> => answer(http.POST('/api/v1/runs', { body: spec }))

/** The newest runs. */
export const listRuns = async (): Promise<RunInfo[]> => (await listRunsFrom(null)).entries

export const listRunsFrom = (cursor: string | null): Promise<Part<RunInfo>> =>
  part(http.GET('/api/v1/runs', { params: { query: { limit: 50, ...(cursor !== null && { cursor }) } } }))

export const getRun = (id: string): Promise<RunInfo> => answer(http.GET('/api/v1/runs/{id}', { params: { path: { id } } }))

export const cancelRun = (id: string): Promise<RunInfo> =>
  answer(http.POST('/api/v1/runs/{id}/cancel', { params: { path: { id } } }))

/** Asks for all configurations of a run that measured a part. */
export const refineRun = (id: string): Promise<RunInfo> =>
  answer(http.POST('/api/v1/runs/{id}/refine', { params: { path: { id } } }))

export const setRunVisibility = (id: string, visibility: Visibility): Promise<RunInfo> =>
  answer(http.PUT('/api/v1/runs/{id}/visibility', { params: { path: { id } }, body: { visibility } }))

export const setObjectVisibility = (id: string, visibility: Visibility): Promise<ObjectInfo> =>
  answer(http.PUT('/api/v1/objects/{id}/visibility', { params: { path: { id } }, body: { visibility } }))

export const getEcdf = (id: string, algorithm: string): Promise<Ecdf> =>
  answer(http.GET('/api/v1/runs/{id}/ecdf', { params: { path: { id }, query: { algorithm } } }))

export const getChart = (id: string, query: { kind: ChartKind; accuracy: Accuracy; where?: string; algorithm?: string }): Promise<Chart> =>
  answer(http.GET('/api/v1/runs/{id}/chart', { params: { path: { id }, query } }))

/** Filters of the board as the API names them; what is left out is chosen. */
export type BoardQuery = Partial<Record<'suite' | 'question' | 'class' | 'hardware' | 'scene' | 'distance' | 'precision', string>> & { accuracy?: Accuracy }

export const getBoard = (query: BoardQuery): Promise<Board> => answer(http.GET('/api/v1/board', { params: { query } }))

export const getStatus = (): Promise<Status> => answer(http.GET('/api/v1/status'))

export const getSuite = (): Promise<SuiteInfo> => answer(http.GET('/api/v1/suite'))

export const boardUrl = (file: string, query: BoardQuery): string => `/api/v1/${file}?${new URLSearchParams(Object.entries(query))}`

export const getHeatmap = (id: string, request: HeatmapRequest): Promise<Heatmap> =>
  answer(http.GET('/api/v1/runs/{id}/heatmap', { params: { path: { id }, query: request } }))

/** How many configurations a selection holds, and its text as the service reads it. */
export const getSelection = (id: string, query: { algorithm: string; where: string }): Promise<Selected> =>
  answer(http.GET('/api/v1/runs/{id}/selection', { params: { path: { id }, query } }))

/** The worst configurations of an algorithm. */
export const getWorst = (
  id: string, query: { algorithm: string; by: 'time' | 'error'; limit: number; where?: string },
): Promise<WorstCase[]> => answer(http.GET('/api/v1/runs/{id}/worst', { params: { path: { id }, query } }))

/** All pairs of triangles that meet in one configuration. */
export const getMeeting = (id: string, configuration: number, rounded: boolean): Promise<Meeting> =>
  answer(http.GET('/api/v1/runs/{id}/configurations/{configuration}/contacts', { params: { path: { id, configuration }, query: { rounded } } }))

export const askAdvice = (spec: AdviceSpec): Promise<AdviceInfo> => answer(http.POST('/api/v1/advice', { body: spec }))

export const getAdvice = (id: string): Promise<AdviceInfo> => answer(http.GET('/api/v1/advice/{id}', { params: { path: { id } } }))

export const cancelAdvice = (id: string): Promise<AdviceInfo> =>
  answer(http.POST('/api/v1/advice/{id}/cancel', { params: { path: { id } } }))

export const getCitation = (kind: 'run' | 'plugin', id: string): Promise<Citation> =>
  answer(kind === 'run' ? http.GET('/api/v1/runs/{id}/citation', { params: { path: { id } } }) : http.GET('/api/v1/plugins/{id}/citation', { params: { path: { id } } }))

export const listExamples = (): Promise<ExampleInfo[]> => answer(http.GET('/api/v1/examples'))

/** The run of the start page, or null while there is none. */
export const getFeatured = (): Promise<RunInfo | null> => answer(http.GET('/api/v1/featured'))

/** Sends a file; the service reads and checks it before it answers. */
export const uploadObject = (file: File): Promise<ObjectInfo> => {
  const form = new FormData()
  form.append('file', file, file.name)
  return answer(
    http.POST('/api/v1/objects', {
      // The document describes the multipart body as an object; the browser writes it from the form.
      body: { file: file.name },
      bodySerializer: () => form,
    }),
  )
}

/** The surface of an object as a binary glTF; vertices in the order of the heatmaps. */
export const fetchMesh = (id: string, signal?: AbortSignal): Promise<ArrayBuffer> => fetchBytes(meshUrl(id), signal)

/** The bytes at an address. */
export async function fetchBytes(url: string, signal?: AbortSignal): Promise<ArrayBuffer> {
  try {
    const response = await fetch(url, signal ? { signal } : {})
    if (!response.ok) throw fromResponse(response.status, await response.json().catch(() => null))
    return await response.arrayBuffer()
  } catch (thrown) {
    throw asApiError(thrown)
  }
}

export const meshUrl = (id: string): string => `/api/v1/objects/${encodeURIComponent(id)}/mesh.glb`

/** Address of something to download that belongs to a run. */
export function downloadUrl(run: string, what: string, query: Record<string, string | undefined>): string {
  const given = Object.entries(query).filter((pair): pair is [string, string] => pair[1] !== undefined)
  return `/api/v1/runs/${encodeURIComponent(run)}/${what}?${new URLSearchParams(given)}`
}
