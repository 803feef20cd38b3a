// A visitor's file in each format: uploaded, shown, and described by what the service read in it.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { until, visitor } from '../visitor.mjs'

/** A pyramid over a polygon of n corners, without its base: n triangles. */
function pyramid(n) {
  const corners = Array.from({ length: n }, (_, i) => [Math.cos((2 * Math.PI * i) / n), Math.sin((2 * Math.PI * i) / n), 0])
  return { points: [...corners, [0, 0, 1.5]], triangles: corners.map((_, i) => [i, (i + 1) % n, n]) }
}

const rows = (lists, before = '') => lists.map((list) => `${before}${list.join(' ')}\n`).join('')

function obj({ points, triangles }) {
  return rows(points, 'v ') + rows(triangles.map((t) => t.map((i) => i + 1)), 'f ')
}

function stl({ points, triangles }) {
  const bytes = Buffer.alloc(84 + 50 * triangles.length)
  bytes.writeUInt32LE(triangles.length, 80)
  triangles.forEach((t, at) => t.flatMap((i) => points[i]).forEach((x, k) => bytes.writeFloatLE(x, 84 + 50 * at + 12 + 4 * k)))
  return bytes
}

function ply({ points, triangles }) {
  const axes = ['x', 'y', 'z'].map((axis) => `property double ${axis}\n`).join('')
  return `ply\nformat ascii 1.0\nelement vertex ${points.length}\n${axes}element face ${triangles.length}\nproperty list uchar int vertex_indices\nend_header\n${rows(points)}${rows(triangles, '3 ')}`
}

function off({ points, triangles }) {
  return `OFF\n${points.length} ${triangles.length} 0\n${rows(points)}${rows(triangles, '3 ')}`
}

/** Positions and indices of a glTF file, and the document around them. */
function scene({ points, triangles }, uri) {
  const data = Buffer.concat([Buffer.from(Float32Array.from(points.flat()).buffer), Buffer.from(Uint32Array.from(triangles.flat()).buffer)])
  const first = 12 * points.length
  const document = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: points.length, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 1.5] },
      { bufferView: 1, componentType: 5125, count: 3 * triangles.length, type: 'SCALAR' },
    ],
    bufferViews: [{ buffer: 0, byteLength: first }, { buffer: 0, byteOffset: first, byteLength: data.length - first }],
    buffers: [{ byteLength: data.length, ...(uri && { uri: `data:application/octet-stream;base64,${data.toString('base64')}` }) }],
  }
  return { document: JSON.stringify(document), data }
}

const gltf = (mesh) => scene(mesh, true).document

function glb(mesh) {
  const { document, data } = scene(mesh, false)
  const json = Buffer.from(document.padEnd(4 * Math.ceil(document.length / 4)))
  const head = Buffer.alloc(20)
  head.write('glTF')
  head.writeUInt32LE(2, 4)
  head.writeUInt32LE(28 + json.length + data.length, 8)
  head.writeUInt32LE(json.length, 12)
  head.write('JSON', 16)
  const body = Buffer.alloc(8)
  body.writeUInt32LE(data.length)
  body.write('BIN\0', 4)
  return Buffer.concat([head, json, body, data])
}

function dae({ points, triangles }) {
  return `<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit name="inch" meter="0.0254"/></asset>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="${3 * points.length}">${points.flat().join(' ')}</float_array>
<technique_common><accessor source="#a" count="${points.length}" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="${triangles.length}"><input semantic="VERTEX" source="#v" offset="0"/><p>${triangles.flat().join(' ')}</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="c"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#c"/></scene></COLLADA>`
}

const FORMATS = { obj, stl, ply, off, gltf, glb, dae }
/** What the page says of the file. */
const SAID = { obj: 'OBJ', stl: 'STL', ply: 'PLY', off: 'OFF', gltf: 'glTF, in metres', glb: 'GLB, in metres', dae: 'COLLADA, in inch (0.0254 m)' }

test('a file in each format is shown with its format, its unit and its triangles', async (t) => {
  const v = await visitor(t)
  await v.go('/new')
  for (const [at, [ending, write]] of Object.entries(FORMATS).entries()) {
    // Another number of sides each: the service keeps one copy of a mesh that comes again.
    const sides = 12 + at
    await v.at('file-input').setInputFiles({ name: `pyramid-${ending}.${ending}`, mimeType: 'application/octet-stream', buffer: Buffer.from(write(pyramid(sides))) })
    const card = v.page.locator('label.card', { has: v.page.getByText(`pyramid-${ending}`, { exact: true }) })
    await card.waitFor()
    await until(`the card of the ${ending} file`, async () => (await card.getAttribute('class')).split(' ').includes('on'))
    assert.match(await card.textContent(), new RegExp(`${sides} triangles`), ending)
    await v.page.getByText(`File: ${SAID[ending]}.`).waitFor()
    await until(`a picture of the ${ending} file`, () => card.locator('canvas').evaluate((canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height)
      return data.some((byte, i) => i % 4 === 3 && byte > 0)
    }))
    const known = (await v.api('/objects')).find(({ name }) => name === `pyramid-${ending}`)
    assert.equal(known.triangles, sides)
    // The command to repeat it names the file as it was uploaded.
    await until(`the command with the ${ending} file`, async () => (await v.at('command').textContent()).includes(`pyramid-${ending}.${ending}`))
  }
  await v.picture('formats')
  await v.accessible('the builder with a file of each format')
  // The figures of the question before are faint while those of this one are on their way.
  await v.page.route('**/api/v1/estimates', () => {})
  await v.at('query-pq').click()
  await v.page.locator('dl.asking').waitFor()
  await v.accessible('the builder while it waits for an estimate')
})
