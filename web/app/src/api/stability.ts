import { answer, http, nothing, part, whole } from './client'
import type { StabilityRunInfo, StabilitySpec, StabilityTable } from './types'

/** Where methods fail, as far as they were tried. */
export const getStability = (): Promise<StabilityTable> => answer(http.GET('/api/v1/stability'))

export const startStability = (spec: StabilitySpec): Promise<StabilityRunInfo> => answer(http.POST('/api/v1/stability-runs', { body: spec }))

/** The visitor's stability runs, newest first, without results. */
export const listStabilityRuns = (): Promise<StabilityRunInfo[]> =>
  whole((query) => part(http.GET('/api/v1/stability-runs', { params: { query } })))

export const getStabilityRun = (id: string): Promise<StabilityRunInfo> =>
  answer(http.GET('/api/v1/stability-runs/{id}', { params: { path: { id } } }))

export const cancelStabilityRun = (id: string): Promise<StabilityRunInfo> =>
  answer(http.POST('/api/v1/stability-runs/{id}/cancel', { params: { path: { id } } }))

/** All that have not ended, without results: for curators. */
export const listOpenStabilityRuns = (): Promise<StabilityRunInfo[]> => answer(http.GET('/api/v1/curation/stability-runs'))

export const deleteStabilityRun = (id: string): Promise<void> =>
  nothing(http.DELETE('/api/v1/stability-runs/{id}', { params: { path: { id } } }))
