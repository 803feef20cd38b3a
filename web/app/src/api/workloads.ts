import { answer, fetchBytes, http, nothing, part, whole } from './client'
import type { ObjectHeatmap, ObjectHeatmapRequest, PosedGroup, PosedScene, Stretch, StretchResult, WorkloadInfo, WorkloadSpec } from './types'

const of = (id: string) => ({ params: { path: { id } } })

/** Sends a recording to be replayed; the service reads it before it answers. The spec comes before the file. */
export const startWorkload = (spec: WorkloadSpec, file: File): Promise<WorkloadInfo> => {
  const form = new FormData()
  form.append('spec', JSON.stringify(spec))
  form.append('file', file, file.name)
  return answer(http.POST('/api/v1/workloads', { body: { file: file.name }, bodySerializer: () => form }))
}

/** The visitor's replays, newest first, without results. */
export const listWorkloads = (): Promise<WorkloadInfo[]> => whole((query) => part(http.GET('/api/v1/workloads', { params: { query } })))

export const getWorkload = (id: string): Promise<WorkloadInfo> => answer(http.GET('/api/v1/workloads/{id}', of(id)))

/** Ends a replay, and what it is then. */
export async function cancelWorkload(id: string): Promise<WorkloadInfo> {
  await answer(http.POST('/api/v1/workloads/{id}/cancel', of(id)))
  return getWorkload(id)
}

/** The same recording once more. */
export const replayAgain = (id: string, spec: WorkloadSpec): Promise<WorkloadInfo> =>
  answer(http.POST('/api/v1/workloads/{id}/again', { ...of(id), body: spec }))

export const deleteWorkload = (id: string): Promise<void> => nothing(http.DELETE('/api/v1/workloads/{id}', of(id)))

/** What each algorithm does within a stretch of the recording. */
export const getStretch = (id: string, query: Stretch): Promise<StretchResult> =>
  answer(http.GET('/api/v1/workloads/{id}/stretch', { params: { path: { id }, query } }))

/** A group as it stands in space. */
export const getGroup = (id: string, query: { sequence?: number; group?: number }): Promise<PosedGroup> =>
  answer(http.GET('/api/v1/workloads/{id}/group', { params: { path: { id }, query } }))

/** The scene with all its objects, and its pairs. */
export const getScene = (id: string): Promise<PosedScene> => answer(http.GET('/api/v1/workloads/{id}/scene', of(id)))

/** Values on the vertices of an object, from all queries that it takes part in. */
export const getObjectHeatmap = (id: string, object: number, query: ObjectHeatmapRequest): Promise<ObjectHeatmap> =>
  answer(http.GET('/api/v1/workloads/{id}/objects/{object}/heatmap', { params: { path: { id, object }, query } }))

/** The same as a file. */
export function objectHeatmapFile(id: string, object: number, end: 'csv' | 'glb' | 'ply', query: ObjectHeatmapRequest, log: boolean): string {
  const given = Object.entries({ ...query, ...(end !== 'csv' && log && { scale: 'log' }) }).filter(([, value]) => value != null)
  return `${workloadFile(id)}/objects/${object}/heatmap.${end}?${new URLSearchParams(given.map(([key, value]) => [key, String(value)]))}`
}

/** An object of the scene as binary glTF. */
export const getWorkloadMesh = (id: string, object: number): Promise<ArrayBuffer> => fetchBytes(`${workloadFile(id)}/objects/${object}/mesh.glb`)

/** Files of a workload; without a name its JSON. */
export const workloadFile = (id: string, file?: 'queries.parquet' | 'recording.ocbrec' | 'reduced.ocbrec'): string =>
  ['/api/v1/workloads', encodeURIComponent(id), ...(file ? [file] : [])].join('/')
