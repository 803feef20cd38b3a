import { describe, expect, it } from 'vitest'
import type { AlgorithmInfo, Query } from '../api/types'
import { commandLine } from './command-line'
import { chosenAlgorithms, fromSpec, initialForm, toSpec, whyUnfit } from './form'
import { find, objectKey, sliderToTriangles, trianglesToSlider, withTriangles } from './objects'

const algorithm = (id: string, queries: Query[]): AlgorithmInfo => ({
  id, name: id, version: '1', authors: '', license: '', url: '', paper: '', queries, counters: true, witness_points: true, single_precision: false, solid: id === 'both', parameters: [],
  plugin_sha256: '',
})
const ALL = [algorithm('both', ['collision_first', 'collision_all', 'proximity']), algorithm('collider', ['collision_first'])]
const form = () => ({ ...initialForm(), objectA: 'stock:bunny' })

describe('toSpec', () => {
  it('asks the usual question as the API wants it', () => {
    expect(toSpec(form(), ALL)).toEqual({
      spec: {
        object_a: 'stock:bunny', query: 'collision_first', method: { kind: 'sphere', sampling: { kind: 'steps', rotate: 20, move: 20 }, seed: 0 },
        relative_distance: 0, algorithms: ['both', 'collider'], passes: 3, budget_seconds: 60,
      },
    })
  })

  it('leaves judging the numbers to the service, but not empty fields', () => {
    expect(toSpec({ ...form(), distance: -1 }, ALL)).toHaveProperty('spec.relative_distance', -1)
    expect(toSpec({ ...form(), thoroughness: 'count', count: 0 }, ALL)).toHaveProperty('spec.method.sampling.count', 0)
    expect(toSpec({ ...form(), distance: '' }, ALL)).toHaveProperty('missing')
    expect(toSpec({ ...form(), thoroughness: 'count', count: 1.5 }, ALL)).toHaveProperty('missing')
    expect(toSpec({ ...form(), off: ['both', 'collider'] }, ALL)).toHaveProperty('missing')
    expect(toSpec(initialForm(), ALL)).toEqual({ missing: 'Choose an object.' })
  })

  it('comes back through fromSpec', () => {
    const asked = { ...form(), objectB: 'stock:dragon', question: 'pq' as const, thoroughness: 'count' as const, count: 500, distance: 0.1, solid: true, off: ['collider'] }
    const made = toSpec(asked, ALL)
    expect('spec' in made && fromSpec(made.spec, ALL)).toEqual(asked)
  })
})

it('filters algorithms by the question and says why', () => {
  const [, collider = algorithm('', [])] = ALL
  expect(whyUnfit(collider, 'proximity', false)).toBe('answers no distance queries')
  expect(whyUnfit(collider, 'collision_all', false)).toBe('stops at the first contact')
  expect(whyUnfit(collider, 'collision_first', false)).toBeNull()
  expect(whyUnfit(collider, 'collision_first', true)).toBe('knows surfaces only, no solid bodies')
  expect(chosenAlgorithms({ ...form(), question: 'pq' }, ALL)).toEqual(['both'])
  expect(chosenAlgorithms({ ...form(), solid: true }, ALL)).toEqual(['both'])
})

it('writes the same run for the command line', () => {
  const made = toSpec({ ...form(), objectB: 'id', contacts: 'all', paper: true }, ALL)
  const solid = toSpec({ ...form(), solid: true }, ALL)
  expect('spec' in solid && commandLine(solid.spec, (id) => id)).toContain('--query cd --solid \\')
  expect('spec' in made && commandLine(made.spec, (id) => (id === 'id' ? "my knot's.obj" : id))).toBe(
    [
      String.raw`ocb bench stock:bunny 'my knot'\''s.obj' \ `,
      String.raw`  --query cd --contacts all \ `,
      String.raw`  --method sphere --rotate 20 --move 20 --paper-compat --distance 0 \ `,
      String.raw`  --algorithm both \ `,
      String.raw`  --passes 3 \ `,
      '  --budget 60',
    ].map((line) => line.trimEnd()).join('\n'),
  )
})

describe('objects', () => {
  it('change their number of triangles and stay the same object', () => {
    expect(withTriangles('stock:gear@2000', 900)).toBe('stock:gear@900')
    expect(withTriangles('stock:bunny', 900)).toBe('stock:bunny')
    expect([objectKey('stock:gear@900'), objectKey('stock:bunny'), objectKey('0192')]).toEqual(['gear', 'bunny', '0192'])
  })

  it('are found at any number of triangles', () => {
    const listed = { id: 'stock:gear@2000', name: 'gear', triangles: 2000, vertices: 1000, bounds: [], sha256: '', terms: '', stock: true, closed: true, warnings: [], created_us: 0 }
    expect(find([listed], 'stock:gear@77')).toBe(listed)
    expect(find([listed], 'stock:sponge@77')).toBeUndefined()
  })

  it('have a slider from the fewest to the most', () => {
    expect([sliderToTriangles(0), sliderToTriangles(1000)]).toEqual([500, 500_000])
    expect(sliderToTriangles(trianglesToSlider(20_000))).toBe(20_000)
  })
})
