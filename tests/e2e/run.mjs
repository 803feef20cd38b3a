// Starts the built service on a data folder of its own, walks all journeys against it, and stops it by its process id.
//
// OCB_E2E_URL walks against a running service instead (with OCB_E2E_CURATOR, the password of its account "curator"); further arguments choose journeys (file names).
import { spawn } from 'node:child_process'
import { readdirSync } from 'node:fs'
import { join } from 'node:path'
import { root, startService } from './service.mjs'

const here = join(root, 'tests/e2e')
const chosen = process.argv.slice(2)
const journeys = readdirSync(join(here, 'journeys'))
  .filter((f) => f.endsWith('.test.mjs') && (chosen.length === 0 || chosen.some((c) => f.startsWith(c))))
  .map((f) => join('journeys', f))
const given = process.env.OCB_E2E_URL
const service = given ? { url: given, stop: async () => {} } : await startService()
const test = spawn(process.execPath, ['--test', '--test-concurrency=1', '--test-reporter=spec', ...journeys], {
  cwd: here,
  stdio: 'inherit',
  env: { ...process.env, OCB_E2E_URL: service.url, OCB_E2E_CURATOR: service.password ?? process.env.OCB_E2E_CURATOR ?? '', OCB_E2E_PICTURES: join(root, 'target/e2e') },
})
const code = await new Promise((done) => test.once('exit', (c) => done(c ?? 1)))
await service.stop()
process.exitCode = code
