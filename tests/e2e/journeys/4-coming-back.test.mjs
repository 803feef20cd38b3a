// Leaving, coming back, waiting behind somebody, and giving up.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { runId, until, visitor } from '../visitor.mjs'

/** Starts a run of some ten seconds or more and returns its id. */
async function startLong(v) {
  await v.go('/new')
  await v.at('stock-card-sponge').click()
  await v.at('by-count').click()
  await v.at('count').fill('20000')
  await until('an estimate', async () => (await v.value('estimate-configurations')) === 20000)
  await v.at('query-pq').click()
  await v.at('effort-whole').click()
  await v.at('start').click()
  return runId(v.page)
}

test('closing the tab loses nothing, a second guest sees the queue, and cancel ends the run', async (t) => {
  const first = await visitor(t)
  const id = await startLong(first)
  await first.at('cancel').waitFor()
  await first.page.reload()
  await first.at('stage-configurations').waitFor()
  await first.go('/')
  await first.page.locator(`a[href*="${id}"]`).first().waitFor()

  const second = await visitor(t)
  const waiting = await startLong(second)
  await until('a queue position', async () => (await second.at('queue-position').count()) && Number(await second.at('queue-position').getAttribute('data-ahead')) > 0)
  await second.accessible('a waiting run')
  await second.picture('waiting')
  // Somebody else's link shows the run but offers no Cancel.
  await second.go(`/r/${id}`)
  await second.at('stage-object').waitFor()
  assert.equal(await second.at('cancel').count(), 0, 'a stranger cannot cancel')

  await second.go(`/r/${waiting}`)
  await second.at('cancel').click()
  await until('the second run to be cancelled', async () => (await second.api(`/runs/${waiting}`)).state === 'cancelled')
  // Its pictures so far are gone with it, and the page may be about to ask for them.
  first.expectRefusal(`/runs/${id}/heatmap`)
  await first.go(`/r/${id}`)
  await first.at('cancel').click()
  await until('the first run to be cancelled', async () => (await first.api(`/runs/${id}`)).state === 'cancelled')
  await first.page.getByText(/cancelled/i).first().waitFor()
  await first.accessible('a cancelled run')
  await first.picture('cancelled')
})

test('an unknown run and an unknown address say so', async (t) => {
  const v = await visitor(t)
  v.expectRefusal('/api/v1/runs/00000000')
  await v.go('/r/00000000-0000-7000-8000-000000000000')
  await v.page.getByRole('alert').first().waitFor()
  await v.accessible('an unknown run')
  await v.go('/no/such/page')
  await v.page.getByRole('heading').first().waitFor()
  await v.accessible('an unknown address')
})
