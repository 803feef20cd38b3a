import { answer, http, nothing, part, whole } from './client'
import type {
  AccountInfo, Credentials, Decision, Identity, InvitationInfo, NewInvitation, NewToken, PluginInfo, Role, Scope, TokenInfo,
} from './types'

export const getAccount = (): Promise<Identity> => answer(http.GET('/api/v1/account'))

export const makeAccount = (body: Credentials): Promise<Identity> => answer(http.POST('/api/v1/account', { body }))

export const logIn = (body: Credentials): Promise<Identity> => answer(http.POST('/api/v1/account/login', { body }))

export const logOut = (): Promise<void> => nothing(http.POST('/api/v1/account/logout'))

export const logOutEverywhere = (): Promise<void> => nothing(http.POST('/api/v1/account/logout-everywhere'))

export const changePassword = (body: { old: string; new: string }): Promise<void> =>
  nothing(http.POST('/api/v1/account/password', { body }))

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

export const listPlugins = (): Promise<PluginInfo[]> =>
  whole((query) => part(http.GET('/api/v1/plugins', { params: { query } })))

export const listCuration = (): Promise<PluginInfo[]> =>
  whole((query) => part(http.GET('/api/v1/curation', { params: { query } })))

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
