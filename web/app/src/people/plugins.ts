import type { Action, InvitationState, PluginInfo, PluginState, Role } from '../api/types'

/** A state in words. */
export const PLUGIN_STATE: Record<PluginState, string> = {
  uploaded: 'waiting for its check',
  vetted: 'being checked',
  failed: 'check failed',
  validated: 'validated, private',
  awaiting: 'waiting for a curator',
  asked: 'question from a curator',
  rejected: 'rejected',
  public: 'public',
  suspended: 'suspended',
  excluded: 'excluded here',
  withdrawn: 'withdrawn',
}

export const isChecking = (state: PluginState): boolean => state === 'uploaded' || state === 'vetted'

export const ROLE: Record<Role, string> = {
  user: 'user',
  developer: 'developer',
  curator: 'curator',
  administrator: 'administrator',
}

/** Where an invitation stands, in words. */
export const INVITATION: Record<InvitationState, string> = {
  open: 'open',
  accepted: 'accepted',
  revoked: 'withdrawn',
  expired: 'expired',
}

const RANK: Role[] = ['user', 'developer', 'curator', 'administrator']

export const isAtLeast = (role: Role | undefined, least: Role): boolean =>
  role !== undefined && RANK.indexOf(role) >= RANK.indexOf(least)

export interface Step {
  action: Action
  text: string
  /** What the reason is for; without it none is asked. */
  reason?: string
}

const OFFER: Step = { action: 'offer', text: 'Offer to the public' }
const ANSWER: Step = { action: 'answer', text: 'Answer', reason: 'Your answer to the curator' }
const WITHDRAW: Step = { action: 'withdraw', text: 'Withdraw' }
const APPROVE: Step = { action: 'approve', text: 'Approve' }
const ASK: Step = { action: 'ask', text: 'Ask the author', reason: 'Your question to the author' }
const REJECT: Step = { action: 'reject', text: 'Reject', reason: 'Reason (shown to the author)' }
const SUSPEND: Step = { action: 'suspend', text: 'Suspend', reason: 'Reason (public)' }
const EXCLUDE: Step = { action: 'exclude', text: 'Exclude on this hardware class', reason: 'Reason (public)' }
const REINSTATE: Step = { action: 'reinstate', text: 'Reinstate', reason: 'Reason (for the log)' }

const END_OWN_CHECK: Step = { action: 'end_check', text: 'End the check' }
const END_CHECK: Step = { action: 'end_check', text: 'End the check', reason: 'Reason (shown to the author)' }

const AUTHORS: Partial<Record<PluginState, Step[]>> = {
  uploaded: [END_OWN_CHECK], vetted: [END_OWN_CHECK], validated: [OFFER], asked: [ANSWER], public: [WITHDRAW], suspended: [WITHDRAW], excluded: [WITHDRAW],
}
const CURATORS: Partial<Record<PluginState, Step[]>> = {
  uploaded: [END_CHECK], vetted: [END_CHECK], awaiting: [APPROVE, ASK, REJECT], asked: [REJECT], public: [SUSPEND, EXCLUDE],
  suspended: [REINSTATE], excluded: [REINSTATE], rejected: [REINSTATE],
}

/** What this viewer may do with the plugin now; nobody decides about their own. */
export function steps(plugin: Pick<PluginInfo, 'mine' | 'state'>, role: Role | undefined): Step[] {
  if (plugin.mine) return AUTHORS[plugin.state] ?? []
  return isAtLeast(role, 'curator') ? (CURATORS[plugin.state] ?? []) : []
}

/** How long ago, in the largest unit that is at least one. */
export function age(us: number, now = Date.now()): string {
  const minutes = Math.max(0, Math.floor((now - us / 1000) / 60_000))
  if (minutes < 1) return 'just now'
  if (minutes < 60) return `${minutes} min ago`
  const hours = Math.floor(minutes / 60)
  return hours < 48 ? `${hours} h ago` : `${Math.floor(hours / 24)} days ago`
}
