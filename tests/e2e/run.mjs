// Walks all journeys, two side by side, each on a built service of its own, which is stopped by its process id.
//
// OCB_E2E_URL walks one after the other against a running service instead (with OCB_E2E_CURATOR, the password of its account
// "curator"); further arguments choose journeys (file names).
import { spawn } from 'node:child_process'
import { readdirSync } from 'node:fs'
import { join } from 'node:path'
import { apart, root, startService } from './service.mjs'

const here = join(root, 'tests/e2e')
const chosen = process.argv.slice(2)
// The long ones first, so that none of them is left alone at the end.
const LONG = ['1-', '7-', '5-', '2-stock', '6-', '2-wall', '9-workload', '9-campaign']
const rank = (file) => [...LONG, ''].findIndex((start) => file.startsWith(start))
const journeys = readdirSync(join(here, 'journeys'))
  .filter((f) => f.endsWith('.test.mjs') && (chosen.length === 0 || chosen.some((c) => f.startsWith(c))))
  .toSorted((a, b) => rank(a) - rank(b))
const given = process.env.OCB_E2E_URL

/** Walks one journey; its output comes as a whole. */
async function walk(journey, service) {
  const test = spawn(apart, [process.execPath, '--test', '--test-reporter=spec', join('journeys', journey)], {
    cwd: here,
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { ...process.env, OCB_E2E_URL: service.url, OCB_E2E_CURATOR: service.password ?? process.env.OCB_E2E_CURATOR ?? '', OCB_E2E_PICTURES: join(root, 'target/e2e') },
  })
  const said = []
  for (const stream of [test.stdout, test.stderr]) stream.on('data', (chunk) => said.push(chunk))
  const code = await new Promise((done) => test.once('close', (c) => done(c ?? 1)))
  process.stdout.write(Buffer.concat(said))
  if (code !== 0) console.log(`${journey} failed; to repeat it: node tests/e2e/run.mjs ${journey.replace('.test.mjs', '')}`)
  return code
}

/** Takes journeys until none is left. */
async function walkAll() {
  const service = given ? { url: given, stop: async () => {} } : await startService({ alone: true })
  let worst = 0
  try {
    for (let next = journeys.shift(); next; next = journeys.shift()) worst = Math.max(worst, await walk(next, service))
  } finally {
    await service.stop()
  }
  return worst
}

const lanes = given ? 1 : Math.min(2, journeys.length)
const walked = await Promise.allSettled(Array.from({ length: lanes }, walkAll))
for (const { reason } of walked) if (reason) console.error(reason)
process.exitCode = Math.max(...walked.map(({ value }) => value ?? 1))
