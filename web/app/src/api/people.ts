import { answer, http, nothing, part, whole, type Part } from './client'
import type {
  AccountInfo, Choices, Credentials, Decision, Identity, InvitationInfo, DeletionPreview, NewChoices, NewInvitation, NewToken, NoticeInfo, PluginInfo, Role, Scope,
  TokenInfo,
} from './types'

export const getAccount = (): Promise<Identity> => answer(http.GET('/api/v1/account'))

export const makeAccount = (body: Credentials): Promise<Identity> => answer(http.POST('/api/v1/account', { body }))

export const logIn = (body: Credentials): Promise<Identity> => answer(http.POST('/api/v1/account/login', { body }))

export const logOut = (): Promise<void> => nothing(http.POST('/api/v1/account/logout'))

export const logOutEverywhere = (): Promise<void> => nothing(http.POST('/api/v1/account/logout-everywhere'))

export const changePassword = (body: { old: string; new: string }): Promise<void> =>
  nothing(http.POST('/api/v1/account/password', { body }))

/** What would go with the account and what would stay. */
export const getDeletionPreview = (): Promise<DeletionPreview> => answer(http.GET('/api/v1/account/deletion-preview'))

export const deleteAccount = (password: string): Promise<DeletionPreview> => answer(http.DELETE('/api/v1/account', { body: { password } }))

export const askToDevelop = (reason: string): Promise<void> =>
  nothing(http.POST('/api/v1/account/developer', { body: { reason } }))

export const listTokens = (): Promise<TokenInfo[]> => answer(http.GET('/api/v1/account/tokens'))

export const makeToken = (name: string, scopes: Scope[]): Promise<NewToken> =>
  answer(http.POST('/api/v1/account/tokens', { body: { name, scopes } }))

export const endToken = (id: string): Promise<void> =>
  nothing(http.DELETE('/api/v1/account/tokens/{id}', { params: { path: { id } } }))

export const registerKey = (publicKey: string): Promise<AccountInfo> =>
  answer(http.POST('/api/v1/account/signing-key', { body: { public_key: publicKey } }))

export const forgetKey = (): Promise<void> => nothing(http.DELETE('/api/v1/account/signing-key'))

export const getChoices = (): Promise<Choices> => answer(http.GET('/api/v1/account/choices'))

/** Changes choices; what is left out stays as it is. */
export const choose = (body: NewChoices): Promise<Choices> => answer(http.PUT('/api/v1/account/choices', { body }))

export const giveAddress = (address: string): Promise<Choices> => answer(http.PUT('/api/v1/account/address', { body: { address } }))

export const forgetAddress = (): Promise<Choices> => answer(http.DELETE('/api/v1/account/address'))

export const confirmAddress = (secret: string): Promise<Choices> =>
  answer(http.POST('/api/v1/account/address/confirmation', { body: { secret } }))

/** By the secret in the link of a mail, whoever is logged in. */
export const turnMailsOff = (secret: string): Promise<void> =>
  nothing(http.POST('/api/v1/mails/off/{secret}', { params: { path: { secret } } }))

export const listNoticesFrom = (cursor: string | null): Promise<Part<NoticeInfo>> =>
  part(http.GET('/api/v1/notices', { params: { query: { limit: 20, ...(cursor !== null && { cursor }) } } }))

export const readNotice = (id: string): Promise<NoticeInfo> =>
  answer(http.POST('/api/v1/notices/{id}/read', { params: { path: { id } } }))

export const removeNotice = (id: string): Promise<void> =>
  nothing(http.DELETE('/api/v1/notices/{id}', { params: { path: { id } } }))

export const listAccounts = (): Promise<AccountInfo[]> =>
  whole((query) => part(http.GET('/api/v1/accounts', { params: { query } })))

export const changeRole = (id: string, role: Role): Promise<AccountInfo> =>
  answer(http.POST('/api/v1/accounts/{id}/role', { params: { path: { id } }, body: { role } }))

export const listInvitations = (): Promise<InvitationInfo[]> =>
  whole((query) => part(http.GET('/api/v1/invitations', { params: { query } })))

export const invite = (recipient: string, days: number): Promise<NewInvitation> =>
  answer(http.POST('/api/v1/invitations', { body: { recipient, days } }))

export const revokeInvitation = (id: string): Promise<InvitationInfo> =>
  answer(http.DELETE('/api/v1/invitations/{id}', { params: { path: { id } } }))

export const acceptInvitation = (secret: string): Promise<AccountInfo> =>
  answer(http.POST('/api/v1/account/invitation', { body: { secret } }))

export const listPluginsFrom = (cursor: string | null): Promise<Part<PluginInfo>> =>
  part(http.GET('/api/v1/plugins', { params: { query: { limit: 50, ...(cursor !== null && { cursor }) } } }))

export const listCurationFrom = (cursor: string | null): Promise<Part<PluginInfo>> =>
  part(http.GET('/api/v1/curation', { params: { query: { limit: 50, ...(cursor !== null && { cursor }) } } }))

export const getPlugin = (id: string): Promise<PluginInfo> =>
  answer(http.GET('/api/v1/plugins/{id}', { params: { path: { id } } }))

export const decide = (id: string, body: Decision): Promise<PluginInfo> =>
  answer(http.POST('/api/v1/plugins/{id}/decisions', { params: { path: { id } }, body }))

/** Sends a plugin; the manifest goes first, so that a slip in it is told before the file is read. */
export const submitPlugin = (file: File, manifest: string, signature: string | null): Promise<PluginInfo> => {
  const form = new FormData()
  form.append('manifest', manifest)
  if (signature !== null) form.append('signature', signature)
  form.append('file', file, file.name)
  return answer(http.POST('/api/v1/plugins', { body: { manifest, file: file.name }, bodySerializer: () => form }))
}
