// A small recording: the spool that a recorder would have written, packed by `ocb record`.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { after } from 'node:test'
import { ocb } from './service.mjs'

const ROW = 256
const [COLLIDE, DISTANCE] = [0, 2]
const [ANSWER_KNOWN, HIT, DISTANCE_KNOWN] = [1, 2, 4]
const OBJECTS = [
  { name: 'ball', geometry: { kind: 'sphere', radius: 0.5 } },
  { name: 'table', geometry: { kind: 'box', size: [1, 1, 1] } },
  { name: 'pole', geometry: { kind: 'capsule', radius: 0.25, length: 1 } },
]
/** Half the width of each along x. */
const HALF = [0.5, 0.5, 0.25]

/** Object `b` at (x, 0, 0) before `a` at the origin, as a recorder writes it; the answer is the true one unless `lie`. */
function row(sequence, [a, b], x, lie) {
  const bytes = Buffer.alloc(ROW)
  const gap = x - HALF[a] - HALF[b]
  const asksDistance = sequence % 2 === 1 && gap > 0
  bytes.writeBigUInt64LE(BigInt(sequence), 0)
  bytes.writeBigUInt64LE(BigInt(Math.floor(sequence / 6)), 8)
  bytes.writeUInt32LE(a, 16)
  bytes.writeUInt32LE(b, 20)
  for (const [at, along] of [[24, 0], [120, x]]) [1, 0, 0, along, 0, 1, 0, 0, 0, 0, 1, 0].forEach((number, i) => bytes.writeDoubleLE(number, at + 8 * i))
  bytes.writeUInt32LE(asksDistance ? DISTANCE : COLLIDE, 216)
  bytes.writeUInt32LE(asksDistance ? DISTANCE_KNOWN : ANSWER_KNOWN + (gap < 0 !== lie ? HIT : 0), 220)
  bytes.writeDoubleLE(gap, 232)
  bytes.writeDoubleLE(2e-6, 240)
  return bytes
}

let folder
after(() => folder && rmSync(folder, { recursive: true, force: true }))
/** Path of a recording of 240 queries about three pairs, one of them answered with a missed collision; it goes when the tests end. */
export function recording() {
  const file = () => join(folder, 'gripper.ocbrec')
  if (folder) return file()
  folder = mkdtempSync(join(tmpdir(), 'ocb-recording-'))
  const write = (name, what) => writeFileSync(join(folder, name), what)
  write('about.json', JSON.stringify({ format: 'opencollbench-spool/1', program: 'gripper', recorder: 'e2e' }))
  write('objects.jsonl', OBJECTS.map((one, id) => `${JSON.stringify({ id, source: '', library: 'libfcl', version: '0.7', ...one })}\n`).join(''))
  write('dropped.jsonl', `${JSON.stringify({ reason: 'continuous queries are not kept', count: 5 })}\n`)
  const pairs = [[0, 1], [0, 2], [1, 2]]
  // There and back, so that parts of the recording differ.
  write('queries.bin', Buffer.concat(Array.from({ length: 240 }, (_, i) => row(i, pairs[i % 3], 1.5 + 1.3 * Math.cos(i / 20), i === 60))))
  ocb(['record', '--spool', folder, '--out', file()])
  return file()
}
