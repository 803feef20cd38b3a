import createClient from 'openapi-fetch'
import { answer, nothing, part, whole } from './client'
import type { Stretch, StretchResult, WorkloadInfo, WorkloadSpec } from './workload-types'

type Gives<T, Status extends number = 200> = { responses: Record<Status, { content: { 'application/json': T } }> }
type Of = { parameters: { path: { id: string } } }

/** The routes of this page. */
interface Paths {
  '/api/v1/workloads': {
    get: { parameters: { query?: { cursor?: string } } } & Gives<WorkloadInfo[]>
    post: { requestBody: { content: { 'multipart/form-data': { spec?: string; file: string } } } } & Gives<WorkloadInfo, 201>
  }
  '/api/v1/workloads/{id}': { get: Of & Gives<WorkloadInfo>; delete: Of & { responses: { 204: { content?: never } } } }
  '/api/v1/workloads/{id}/cancel': { post: Of & Gives<WorkloadInfo> }
  '/api/v1/workloads/{id}/again': { post: Of & { requestBody: { content: { 'application/json': WorkloadSpec } } } & Gives<WorkloadInfo, 201> }
  '/api/v1/workloads/{id}/stretch': { get: { parameters: { path: { id: string }; query?: Stretch } } & Gives<StretchResult> }
}
const http = createClient<Paths>({ baseUrl: '/' })

const of = (id: string) => ({ params: { path: { id } } })

/** Sends a recording to be replayed; the service reads it before it answers. What is asked comes before the file. */
export const startWorkload = (spec: WorkloadSpec, file: File): Promise<WorkloadInfo> => {
  const form = new FormData()
  form.append('spec', JSON.stringify(spec))
  form.append('file', file, file.name)
  return answer(http.POST('/api/v1/workloads', { body: { file: file.name }, bodySerializer: () => form }))
}

/** The visitor's replays, newest first, without results. */
export const listWorkloads = (): Promise<WorkloadInfo[]> => whole((query) => part(http.GET('/api/v1/workloads', { params: { query } })))

export const getWorkload = (id: string): Promise<WorkloadInfo> => answer(http.GET('/api/v1/workloads/{id}', of(id)))

export const cancelWorkload = (id: string): Promise<WorkloadInfo> => answer(http.POST('/api/v1/workloads/{id}/cancel', of(id)))

/** The same recording once more. */
export const replayAgain = (id: string, spec: WorkloadSpec): Promise<WorkloadInfo> =>
  answer(http.POST('/api/v1/workloads/{id}/again', { ...of(id), body: spec }))

export const deleteWorkload = (id: string): Promise<void> => nothing(http.DELETE('/api/v1/workloads/{id}', of(id)))

/** What each algorithm does within a stretch of the recording. */
export const getStretch = (id: string, query: Stretch): Promise<StretchResult> =>
  answer(http.GET('/api/v1/workloads/{id}/stretch', { params: { path: { id }, query } }))

export const workloadFile = (id: string, file: 'workload.json' | 'queries.parquet' | 'recording.ocbrec'): string =>
  `/api/v1/workloads/${encodeURIComponent(id)}/${file}`
