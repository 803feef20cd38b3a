// A developer from registration to the public benchmark, past a curator who says no and then yes; and a user.
import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join, resolve } from 'node:path'
import { test } from 'node:test'
import { fileURLToPath } from 'node:url'
import { enter, runId, until, visitor } from '../visitor.mjs'

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../../..')
const PASSWORD = 'a long enough password'

/** Compiles the template of a plugin in C, with a lie when one is given. */
function plugin(folder, name, lie = '') {
  const template = readFileSync(join(root, 'plugin-api/templates/c/my_plugin.c'), 'utf8')
  const source = join(folder, `${name}.c`)
  writeFileSync(source, template.replace('    result->hit = 0;\n    return OCB_OK;', `    result->hit = 0;\n${lie}\n    return OCB_OK;`))
  const library = join(folder, `${name}.so`)
  execFileSync('cc', ['-std=c11', '-O2', '-fPIC', '-shared', '-fvisibility=hidden', '-ffp-contract=off',
    '-I', join(root, 'plugin-api/include'), source, '-o', library])
  return library
}

async function submit(v, file, version) {
  await v.go('/submit')
  await v.at('plugin-file').setInputFiles(file)
  const fields = { name: 'All pairs', version, authors: 'Ada', license: 'MIT OR Apache-2.0', source: 'https://example.org/all-pairs' }
  for (const [field, text] of Object.entries(fields)) await v.at(`manifest-${field}`).fill(text)
  if (version === '0.9') {
    await v.accessible('the form of a submitted plugin')
    await v.picture('submit')
  }
  await v.at('submit-plugin').click()
  await v.page.waitForURL(/\/p\/[0-9a-f-]{36}/)
  return /\/p\/([0-9a-f-]{36})/.exec(v.page.url())[1]
}

const state = (v, wanted, seconds) => until(`the plugin to be ${wanted}`, async () =>
  (await v.at('plugin-state').count()) && (await v.at('plugin-state').getAttribute('data-state')) === wanted, seconds)

test('a developer publishes a plugin, a curator decides, a user benchmarks it', async (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'ocb-plugin-'))
  t.after(() => rmSync(folder, { recursive: true, force: true }))
  const password = process.env.OCB_E2E_CURATOR
  assert.ok(password, 'OCB_E2E_CURATOR must be the password of the account "curator"')
  const [developer, curator, user] = [await visitor(t), await visitor(t, { scheme: 'dark' }), await visitor(t)]

  // Registered, and welcomed by a curator.
  await developer.go('/account')
  await developer.at('account-name').waitFor()
  await developer.accessible('the account page of a guest')
  await enter(developer, 'ada', PASSWORD, true)
  await developer.at('developer-request').fill('I have all pairs of triangles.')
  await developer.at('ask-developer').click()
  await developer.page.getByText('A curator will decide').waitFor()
  await developer.accessible('the account page')
  await developer.picture('account')
  await enter(curator, 'curator', password)
  await curator.go('/curate')
  await curator.at('request-ada').waitFor()
  await curator.accessible('the page of curators')
  await curator.at('welcome-ada').click()
  await curator.page.getByText('No pending requests.').waitFor()

  // A plugin that misses collisions gets no further, and says which.
  await submit(developer, plugin(folder, 'liar', '    if (a->triangle_count > 0) result->hit = pose_b[3] > pose_a[3];'), '0.9')
  await state(developer, 'failed', 240)
  await developer.accessible('a report that says no')
  await developer.picture('plugin-failed')

  // The honest one passes, line by line; a stranger does not know of it.
  const id = await submit(developer, plugin(folder, 'honest'), '1.0')
  await developer.at('report-line').first().waitFor()
  await state(developer, 'validated', 240)
  assert.ok((await developer.at('report-line').count()) > 10)
  await developer.accessible('a report that says yes')
  await developer.picture('plugin-validated')
  user.expectRefusal(`/api/v1/plugins/${id}`)
  await user.go(`/p/${id}`)
  await user.page.getByRole('alert').waitFor()

  // Offered, refused, and after all accepted.
  await developer.at('step-offer').click()
  await state(developer, 'awaiting')
  await curator.go('/curate')
  await curator.at('plugin-All pairs').getByRole('link').click()
  await curator.at('step-reject').click()
  await curator.at('reason').fill('Please say in the paper field where the test between triangles comes from.')
  await curator.at('step-reject').click()
  await state(curator, 'rejected')
  await developer.page.reload()
  await developer.at('plugin-reason').getByText('where the test between triangles comes from').waitFor()
  await curator.at('step-reinstate').click()
  await curator.at('reason').fill('The author wrote by e-mail.')
  await curator.at('step-reinstate').click()
  await state(curator, 'public')
  await curator.at('history').getByText('rejected').waitFor()
  await curator.accessible('a public plugin')
  await curator.picture('plugin-public')

  // Its author was told, above the runs; what is read goes out of the way, and what is removed is gone.
  await developer.go('/runs')
  const told = (which) => developer.at(which).filter({ hasText: 'Your plugin All pairs 1.0 was reinstated' })
  await told('notice').getByText('The author wrote by e-mail.').waitFor()
  await developer.accessible('my runs with notices')
  await developer.picture('notices')
  await told('notice').getByTestId('read-notice').click()
  await told('notice').waitFor({ state: 'detached' })
  await developer.at('earlier-notices').locator('summary').click()
  await told('read').getByTestId('remove-notice').click()
  await told('read').waitFor({ state: 'detached' })
  assert.equal((await developer.api('/notices')).filter((one) => one.subject.endsWith('was reinstated')).length, 0)
  await developer.at('notice').filter({ hasText: 'Your plugin All pairs 0.9 failed its check' }).getByRole('link').click()
  await state(developer, 'failed')

  // Mails are off until they are wanted, and this service sends none, which it says.
  await developer.go('/account')
  await developer.at('where-mails-go').getByText('sends no mails').waitFor()
  await developer.at('mail-notices').check()
  await developer.at('address').fill('ada@example.org')
  await developer.at('give-address').click()
  await developer.at('forget-address').waitFor()
  const choices = { agrees_to_reruns: false, mail_notices: true, address: 'ada@example.org', confirmed: false, mailing: false }
  assert.deepEqual(await developer.api('/account/choices'), choices)
  await developer.accessible('the choices of an account')

  // Everybody may measure it now.
  await user.go('/plugins')
  await user.at('plugin-All pairs').waitFor()
  await user.accessible('the list of plugins')
  await user.go('/new')
  await user.at('stock-card-torus-knot').click()
  // The slider's lower end: all pairs of triangles take long on more.
  await user.at('triangles').fill('0')
  await user.at('by-count').click()
  await user.at('count').fill('20')
  await user.at('algorithm-my-algorithm-c').click()
  await user.at('start').click()
  const run = await runId(user.page)
  await until('the run to end', async () => (await user.api(`/runs/${run}`)).state === 'done')
  const results = (await user.api(`/runs/${run}`)).results
  assert.ok(results.some((result) => result.algorithm === 'my-algorithm-c' && result.n === 20 && result.wrong === 0), JSON.stringify(results.map((r) => [r.algorithm, r.n, r.wrong, r.outcome])))
})
