// The machine is another one: a curator has the suite measured again, and everybody sees old and new side by side.
import assert from 'node:assert/strict'
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { test } from 'node:test'
import { addCurator, built, ocb, startService } from '../service.mjs'
import { until, visitor } from '../visitor.mjs'

const SUITE = {
  version: 9, scenes: [['stock:torus-knot@600', 'stock:torus-knot@600']], separations: [{ kind: 'relative', distance: 0.1 }],
  queries: ['collision_first', 'proximity'], configurations: 40, seed: 1, passes: 3, budget_seconds: 5,
}

test('a curator has stored results measured again and watches them stand side by side', async (t) => {
  const data = mkdtempSync(join(tmpdir(), 'ocb-campaign-'))
  t.after(() => rmSync(data, { recursive: true, force: true }))
  const suite = join(data, 'suite.json')
  writeFileSync(suite, JSON.stringify(SUITE))
  const options = ['--suite-file', suite, ...['libocb_box_tree.so', 'libocb_brute_force.so'].flatMap((name) => ['--plugins', built(name)])]
  ocb(['suite', 'run', '--data', data, '--machine-note', 'turbo on', ...options])
  const password = addCurator(data)
  const service = await startService({ data, options: [...options, '--machine-note', 'turbo off'] })
  t.after(service.stop)
  const [curator, guest] = [await visitor(t, { base: service.url, scheme: 'dark' }), await visitor(t, { base: service.url })]

  await guest.go('/campaigns')
  await guest.page.getByText('There are no campaigns yet.').waitFor()
  await guest.accessible('no campaigns')
  assert.equal(await guest.at('campaign-begin').count(), 0, 'the button is for curators')

  await curator.go('/account')
  await curator.at('account-name').fill('curator')
  await curator.at('account-password').fill(password)
  await curator.at('account-enter').click()
  await curator.at('account-who').waitFor()
  await curator.go('/curate')
  await curator.at('to-campaigns').click()
  await until('the preview to count two runs', async () =>
    (await curator.at('campaign-preview').count()) && (await curator.at('campaign-preview').getAttribute('data-runs')) === '2')
  await curator.at('campaign-preview').getByText('2 runs of suite 9 (2 of them measured before)').waitFor()
  await curator.at('campaign-preview').getByText('of measuring').waitFor()
  await curator.at('campaign-reason').fill('Turbo is off now.')
  await curator.accessible('the button that measures again')
  await curator.picture('campaign-begin')
  await curator.at('campaign-begin').click()

  // Watched to its end, without a reload.
  await curator.page.waitForURL(/\/campaigns\/[0-9a-f-]{36}/)
  await until('the campaign to be done', async () =>
    (await curator.at('campaign-state').count()) && (await curator.at('campaign-state').getAttribute('data-state')) === 'done', 120)
  await curator.at('campaign-progress').getByText('2 done of 2 runs').waitFor()
  const rows = curator.at('comparison').locator('tbody tr')
  assert.equal(await rows.count(), 4)
  const ratios = await rows.evaluateAll((all) => all.map((row) => Number(row.getAttribute('data-ratio'))))
  assert.ok(ratios.every((ratio) => ratio > 0), `${ratios}`)
  await curator.accessible('old and new side by side')
  await curator.picture('campaign-done')

  // The page shows what the API says, and everybody sees it.
  const id = /\/campaigns\/([0-9a-f-]{36})/.exec(curator.page.url())[1]
  const campaign = await guest.api(`/campaigns/${id}`)
  assert.deepEqual(campaign.results.map((row) => row.ratio.value), ratios)
  assert.ok(campaign.results.every((row) => row.old.hardware_class !== row.new.hardware_class))
  await guest.go('/campaigns')
  await guest.at('campaign').getByRole('link', { name: 'Turbo is off now.' }).click()
  await guest.at('comparison').waitFor()
  await guest.accessible('a campaign that a guest looks at')
  await curator.go('/campaigns')
  await curator.at('campaign-preview').getByText('Nothing to measure again').waitFor()
  assert.ok(await curator.at('campaign-begin').isDisabled())
})
