import { answer, http, part, whole } from './client'
import type { SavedConfigurations } from './types'

export const listSaved = (): Promise<SavedConfigurations[]> =>
  whole((query) => part(http.GET('/api/v1/configurations', { params: { query } })))

export function saveFile(file: File): Promise<SavedConfigurations> {
  const form = new FormData()
  form.append('file', file, file.name)
  return answer(
    http.POST('/api/v1/configurations', {
      // The document describes the multipart body as an object; the browser writes it from the form.
      body: { file: file.name },
      bodySerializer: () => form,
    }),
  )
}

/** Saves those that a run was measured on. */
export const saveOfRun = (id: string): Promise<SavedConfigurations> =>
  answer(http.POST('/api/v1/runs/{id}/save-configurations', { params: { path: { id } } }))

export const savedUrl = (id: string): string => `/api/v1/configurations/${encodeURIComponent(id)}/file`
