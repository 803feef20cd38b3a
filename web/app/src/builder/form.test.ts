import { describe, expect, it } from 'vitest'
import type { AlgorithmInfo, Method, Query } from '../api/types'
import { commandLine } from './command-line'
import { type BuilderForm, chosenAlgorithms, fromSpec, initialForm, nameWith, settingsOf, toSpec, whyUnfit } from './form'
import { find, objectKey, sliderToTriangles, trianglesToSlider, withTriangles } from './objects'

const algorithm = (id: string, queries: Query[]): AlgorithmInfo => ({
  id, name: id, version: '1', authors: '', license: '', url: '', paper: '', queries, counters: true, witness_points: true, single_precision: false, solid: id === 'both', coherent: false, threads: false, usual: true, parameters: [],
  plugin_sha256: '',
})
const ALL = [algorithm('both', ['collision_first', 'collision_all', 'proximity']), algorithm('collider', ['collision_first'])]
const form = () => ({ ...initialForm(), objectA: 'stock:bunny' })

describe('toSpec', () => {
  it('asks the usual question as the API wants it', () => {
    expect(toSpec(form(), ALL)).toEqual({
      spec: {
        object_a: 'stock:bunny', query: 'collision_first', method: { kind: 'sphere', sampling: { kind: 'steps', rotate: 20, move: 20 }, seed: 0 },
        separation: { kind: 'relative', distance: 0 }, algorithms: ['both', 'collider'], passes: 5, budget_seconds: 60,
      },
    })
  })

  it('leaves judging the numbers to the service, but not empty fields', () => {
    expect(toSpec({ ...form(), distance: -1 }, ALL)).toHaveProperty('spec.separation', { kind: 'relative', distance: -1 })
    expect(toSpec({ ...form(), thoroughness: 'count', count: 0 }, ALL)).toHaveProperty('spec.method.sampling.count', 0)
    expect(toSpec({ ...form(), distance: '' }, ALL)).toHaveProperty('missing')
    expect(toSpec({ ...form(), thoroughness: 'count', count: 1.5 }, ALL)).toHaveProperty('missing')
    expect(toSpec({ ...form(), algorithms: [] }, ALL)).toHaveProperty('missing')
    expect(toSpec(initialForm(), ALL)).toEqual({ missing: 'Choose an object.' })
  })

  it('comes back through fromSpec', () => {
    const asked = { ...form(), objectB: 'stock:dragon', question: 'pq' as const, thoroughness: 'count' as const, count: 500, distance: 0.1, solid: true, algorithms: ['both'], hardwareClass: 'new' }
    const grid = { ...form(), method: 'grid' as const, paper: true, rotate: 15, separation: 'step' as const, step: -1e-6 }
    const ladder = { ...form(), method: 'grid' as const, separation: 'ladder' as const }
    const trajectory = { ...form(), method: 'trajectory' as const, count: 700, centerDistance: 0.8 }
    const random = { ...form(), method: 'random' as const, count: 900, hitShare: 0.25 }
    const seeded = [asked, grid, ladder, random].map((wish) => ({ ...wish, seed: 17 }))
    const given = { ...form(), method: 'file' as const, poses: '5eed'.repeat(16) }
    for (const wish of [asked, grid, ladder, trajectory, random, ...seeded, given]) {
      const made = toSpec(wish, ALL)
      expect('spec' in made && fromSpec(made.spec, ALL)).toEqual({ ...wish, algorithms: chosenAlgorithms(wish, ALL) })
    }
  })
})

describe('the methods', () => {
  const made = (change: Partial<BuilderForm>) => {
    const wish = toSpec({ ...form(), ...change }, ALL)
    if ('missing' in wish) return { missing: wish.missing }
    const { method, separation } = wish.spec
    return { asked: { method, separation }, line: commandLine(wish.spec, (id) => id).split('\n')[2]?.trim().replace(/ \\$/, '') }
  }
  const sampling = { kind: 'count', count: 500 }
  const counted = { thoroughness: 'count', count: 500 } as const

  it('say one separation, and that only where the method looks for one', () => {
    const left = { separation: 'step', step: 0.1, distance: 0.2 } as const
    expect(made({ ...counted, ...left, method: 'grid' })).toEqual({
      asked: { method: { kind: 'grid', sampling, seed: 0 }, separation: { kind: 'step', of_size: 0.1 } }, line: '--method grid --count 500 --step=0.1',
    })
    expect(made({ ...counted, ...left, step: -1e-7 }).line).toBe('--method sphere --count 500 --step=-1e-7')
    expect(made({ ...counted, ...left, separation: 'ladder' })).toEqual({
      asked: { method: { kind: 'sphere', sampling, seed: 0 }, separation: { kind: 'ladder' } }, line: '--method sphere --count 500 --ladder',
    })
    expect(made({ ...counted, ...left, method: 'trajectory', centerDistance: 0.9 })).toEqual({
      asked: { method: { kind: 'trajectory', center_distance: 0.9, count: 500 } }, line: '--method trajectory --center-distance 0.9 --count 500',
    })
    expect(made({ ...counted, ...left, method: 'random', hitShare: 0.3 })).toEqual({
      asked: { method: { kind: 'random', count: 500, hit_share: 0.3, seed: 0 } }, line: '--method random --count 500 --hit-share 0.3',
    })
  })

  it('keep their seed and their poses when a run is asked again', () => {
    const poses = '5eed'.repeat(16)
    const again = (method: Method) => made(fromSpec({ object_a: 'stock:bunny', query: 'proximity', method }, ALL))
    expect(again({ kind: 'sphere', sampling: { kind: 'count', count: 500 }, seed: 17 })).toEqual({
      asked: { method: { kind: 'sphere', sampling, seed: 17 }, separation: { kind: 'relative', distance: 0 } }, line: '--method sphere --count 500 --seed 17 --distance 0',
    })
    expect(again({ kind: 'random', count: 500, hit_share: 0.3, seed: 18 })).toEqual({
      asked: { method: { kind: 'random', count: 500, hit_share: 0.3, seed: 18 } }, line: '--method random --count 500 --hit-share 0.3 --seed 18',
    })
    expect(again({ kind: 'file', sha256: poses })).toEqual({ asked: { method: { kind: 'file', sha256: poses } }, line: '--configurations configurations.parquet' })
    expect(made({ method: 'file' })).toHaveProperty('missing')
    // What a browser cannot hold would be sent as another number.
    expect(again({ kind: 'random', count: 500, hit_share: 0.3, seed: 2 ** 53 })).toHaveProperty('missing')
    expect(made({ seed: '' })).toHaveProperty('missing')
    expect(made({ method: 'trajectory', seed: '' })).toHaveProperty('asked')
    expect(made({ paper: true, seed: '' })).toHaveProperty('asked')
  })

  it('name the field that is empty, and none that the method does not have', () => {
    expect(made({ separation: 'step', step: '' })).toEqual({ missing: 'Give a step, for example 0.01, or -0.01 for crossing objects.' })
    expect(made({ method: 'trajectory', centerDistance: '' })).toEqual({ missing: 'Give the distance of the centres; 1 is the usual one.' })
    expect(made({ method: 'random', hitShare: '' })).toEqual({ missing: 'Give the share of colliding poses, for example 0.5.' })
    expect(made({ method: 'random', count: '' })).toEqual({ missing: 'Give the number of configurations.' })
    expect(made({ method: 'trajectory', rotate: '', distance: '', step: '', hitShare: '' })).toHaveProperty('asked')
    expect(made({ separation: 'ladder', distance: '', step: '', centerDistance: '' })).toHaveProperty('asked')
  })
})

it('filters algorithms by the question and says why', () => {
  const [, collider = algorithm('', [])] = ALL
  expect(whyUnfit(collider, 'proximity', false)).toBe('answers no distance queries')
  expect(whyUnfit(collider, 'collision_all', false)).toBe('stops at the first contact')
  expect(whyUnfit(collider, 'collision_first', false)).toBeNull()
  expect(whyUnfit({ ...collider, single_precision: true }, 'collision_first', false, true)).toContain('no triangle of the object has an area')
  expect(whyUnfit(collider, 'collision_first', false, true)).toBeNull()
  expect(whyUnfit(collider, 'collision_first', true)).toBe('supports surfaces only, no solid bodies')
  expect(chosenAlgorithms({ ...form(), question: 'pq' }, ALL)).toEqual(['both'])
  expect(chosenAlgorithms({ ...form(), solid: true }, ALL)).toEqual(['both'])
})

it('measures several settings of an algorithm, each under its whole name', () => {
  const knobs = ['size', 'slack'].map((name) => ({ name, description: '', minimum: 0, maximum: 9, default: 1, integer: false }))
  expect(nameWith('both', knobs, { slack: 0.5, size: '' })).toBe('both:slack=0.5')
  expect(nameWith('both', knobs, { slack: 1 })).toBe('both')
  expect(settingsOf('both:size=2:slack=0.5')).toBe('size 2, slack 0.5')
  const wish = { ...form(), algorithms: ['gone', 'collider', 'both:size=2', 'both'] }
  const made = toSpec(wish, ALL)
  expect(made).toHaveProperty('spec.algorithms', ['both:size=2', 'both', 'collider'])
  expect('spec' in made && fromSpec({ ...made.spec, algorithms: wish.algorithms }, ALL).algorithms).toEqual(['collider', 'both:size=2', 'both'])
})

it('measures the usual algorithms when nothing is chosen', () => {
  const [both = algorithm('', []), collider = algorithm('', [])] = ALL
  expect(chosenAlgorithms(form(), [both, { ...collider, usual: false }])).toEqual(['both'])
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
      String.raw`  --passes 5 \ `,
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
    const listed = { id: 'stock:gear@2000', name: 'gear', triangles: 2000, vertices: 1000, bounds: [], sha256: '', terms: '', stock: true, closed: true, warnings: [], created_us: 0, visibility: 'public' as const, mine: false }
    expect(find([listed], 'stock:gear@77')).toBe(listed)
    expect(find([listed], 'stock:sponge@77')).toBeUndefined()
  })

  it('have a slider from the fewest to the most', () => {
    expect([sliderToTriangles(0), sliderToTriangles(1000)]).toEqual([500, 500_000])
    expect(sliderToTriangles(trianglesToSlider(20_000))).toBe(20_000)
  })
})
