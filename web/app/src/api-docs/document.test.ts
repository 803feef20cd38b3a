import { readFileSync } from 'node:fs'
import { describe, expect, it } from 'vitest'
import { fields, groups, shapes, typeText, type Document } from './document'

const document = JSON.parse(readFileSync('../server/openapi.json', 'utf8')) as Document
const all = groups(document, 'http://127.0.0.1:8080').flatMap(({ routes }) => routes)

describe('the API page', () => {
  it('shows every route of the document, once', () => {
    const wanted = Object.entries(document.paths).flatMap(([path, methods]) => Object.keys(methods).map((m) => `${m.toUpperCase()} ${path}`))
    expect(all.map(({ method, path }) => `${method} ${path}`).toSorted()).toEqual(wanted.toSorted())
    expect(new Set(all.map(({ id }) => id)).size).toBe(all.length)
  })

  it('shows every schema, and every name that a type mentions is one of them', () => {
    const known = shapes(document)
    expect(known.map(({ name }) => name)).toEqual(Object.keys(document.components?.schemas ?? {}).toSorted((a, b) => a.localeCompare(b)))
    const names = new Set(known.map(({ name }) => name))
    const mentioned = [
      ...all.flatMap(({ answers, body, parameters }) => [...answers, ...parameters, ...(body ? [body] : [])]),
      ...known.flatMap(({ forms }) => forms.flatMap((form) => form.fields)),
    ].flatMap(({ type }) => type.names)
    expect(mentioned.length).toBeGreaterThan(20)
    expect(mentioned.filter((name) => !names.has(name))).toEqual([])
  })

  it('says every type in words', () => {
    expect(typeText({ type: ['string', 'null'] }).text).toBe('string | null')
    expect(typeText({ type: 'array', items: { $ref: '#/components/schemas/Stage' } })).toEqual({ text: 'list of Stage', names: ['Stage'] })
    expect(typeText({ oneOf: [{ type: 'null' }, { $ref: '#/components/schemas/Draw' }] }).text).toBe('null | Draw')
    expect(typeText({ type: 'string', enum: ['cd', 'pq'] }).text).toBe('"cd" | "pq"')
    expect(typeText({ type: 'object', additionalProperties: { type: 'number' } }).text).toBe('map from names to number')
  })

  it('lists what must be there first', () => {
    const some = fields({ required: ['b'], properties: { a: { type: 'string' }, b: { type: 'number', description: 'Size.' } } })
    expect(some.map(({ name, required, text }) => [name, required, text])).toEqual([['b', true, 'Size.'], ['a', false, '']])
  })

  it('gives a command line that can be pasted, with the example of the document', () => {
    const command = (id: string) => all.find((route) => route.id === id)?.command ?? ''
    expect(command('show_run')).toBe("curl 'http://127.0.0.1:8080/api/v1/runs/ID'")
    expect(command('show_ecdf')).toBe("curl 'http://127.0.0.1:8080/api/v1/runs/ID/ecdf?algorithm=ALGORITHM'")
    expect(command('add_object')).toContain('-F file=@FILE')
    expect(command('start_run')).toMatch(/^curl -X POST -H 'Content-Type: application\/json' -d '.*"object_a":"stock:/)
  })
})
