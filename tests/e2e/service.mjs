// The built service on a data folder, stopped by its process id.
import { spawn, spawnSync } from 'node:child_process'
import { randomUUID } from 'node:crypto'
import { mkdtempSync, rmSync } from 'node:fs'
import { createServer } from 'node:net'
import { tmpdir } from 'node:os'
import { dirname, join, resolve } from 'node:path'
import { fileURLToPath } from 'node:url'

export const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..')
const target = resolve(root, process.env.CARGO_TARGET_DIR ?? 'target')

/** A command that runs another as on hardware of its own. */
export const apart = join(root, 'tests/setup/apart.sh')

/** A built file, such as `ocb` or a plugin. */
export const built = (name) => join(target, 'release', name)

/** Runs `ocb` to its end, with this exit code. */
export function ocb(args, env = {}, code = 0) {
  const ended = spawnSync(built('ocb'), args, { env: { ...process.env, ...env }, encoding: 'utf8' })
  if (ended.status !== code) throw new Error(`ocb ${args.join(' ')}: ${ended.stderr}`)
  return ended.stdout
}

/** Makes the account "curator" on a data folder that no service has open, and gives its password. */
export function addCurator(data) {
  const password = randomUUID()
  ocb(['admin', 'create', 'curator', '--role', 'curator', '--data', data], { OCB_PASSWORD: password })
  return password
}

/** A port of the loopback interface that nobody listens on. */
export function freePort() {
  return new Promise((done) => {
    const server = createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address()
      server.close(() => done(port))
    })
  })
}

async function ready(url, alive) {
  for (let i = 0; i < 300 && alive(); i++) {
    const answer = await fetch(`${url}/api/v1/status`).catch(() => null)
    if (answer?.ok) return
    await new Promise((next) => setTimeout(next, 100))
  }
  throw new Error(`the service did not answer on ${url}`)
}

/** Serves this data folder, or a new one with a curator that goes away with the service, at a new address unless one is given; nothing is measured unasked, unless `idle`. `alone` waits for no other that measures. */
export async function startService({ data: given, url: known, options: more = [], idle = false, alone = false } = {}) {
  const url = known ?? `http://127.0.0.1:${await freePort()}`
  const data = given ?? mkdtempSync(join(tmpdir(), 'ocb-e2e-'))
  const password = given ? undefined : addCurator(data)
  const options = ['serve', '--data', data, '--listen', url.slice('http://'.length), '--stock-dir', join(root, 'target/stock'), '--idle', idle ? 'on' : 'off', ...more]
  const [command, ...prefix] = alone ? [apart, built('ocb')] : [built('ocb')]
  const service = spawn(command, [...prefix, ...options], { cwd: root, stdio: ['ignore', 'inherit', 'inherit'] })
  const ended = new Promise((done) => service.once('exit', (code, signal) => done(signal ?? code)))
  let running = true
  ended.then(() => { running = false })
  const stop = async () => {
    const early = !running
    service.kill('SIGTERM')
    const how = await ended
    if (!given) rmSync(data, { recursive: true, force: true })
    if (early) throw new Error(`the service ended by itself during the journeys (${how})`)
  }
  try {
    await ready(url, () => running)
  } catch (error) {
    await stop().catch(() => {})
    throw error
  }
  /** Ends it at once, as a power cut does. */
  const kill = () => {
    service.kill('SIGKILL')
    return ended
  }
  return { url, password, stop, kill }
}
