import { answer, http, part, whole } from './client'
import type { CampaignInfo, CampaignPreview, CampaignRequest } from './types'

/** What a campaign measures. */
export interface What {
  suite: boolean
  people: boolean
  hardware_class?: string
}

export const previewCampaign = (query: What): Promise<CampaignPreview> =>
  answer(http.GET('/api/v1/campaigns/preview', { params: { query } }))

export const createCampaign = (body: CampaignRequest): Promise<CampaignInfo> => answer(http.POST('/api/v1/campaigns', { body }))

export const listCampaigns = (): Promise<CampaignInfo[]> =>
  whole((query) => part(http.GET('/api/v1/campaigns', { params: { query } })))

export const getCampaign = (id: string): Promise<CampaignInfo> =>
  answer(http.GET('/api/v1/campaigns/{id}', { params: { path: { id } } }))

export const cancelCampaign = (id: string): Promise<CampaignInfo> =>
  answer(http.POST('/api/v1/campaigns/{id}/cancel', { params: { path: { id } } }))
