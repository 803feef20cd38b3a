/** Turns the service's OpenAPI document into what the API page shows. Pure. */

/** The part of JSON Schema that the document uses. */
export interface Schema {
  $ref?: string
  type?: string | string[]
  format?: string
  description?: string
  enum?: unknown[]
  items?: Schema
  prefixItems?: Schema[]
  properties?: Record<string, Schema>
  additionalProperties?: Schema | boolean
  required?: string[]
  oneOf?: Schema[]
  allOf?: Schema[]
  anyOf?: Schema[]
  example?: unknown
}
interface Content {
  schema?: Schema
  example?: unknown
}
interface Operation {
  operationId: string
  tags?: string[]
  summary?: string
  description?: string
  parameters?: { name: string; in: string; required?: boolean; description?: string; schema?: Schema }[]
  requestBody?: { content: Record<string, Content>; required?: boolean }
  responses: Record<string, { description?: string; content?: Record<string, Content> }>
}
export interface Document {
  info: { title: string; description?: string; version: string }
  tags?: { name: string; description?: string }[]
  paths: Record<string, Record<string, Operation>>
  components?: { schemas?: Record<string, Schema> }
}

/** A type in words, with the names of the schemas that it mentions. */
export interface TypeText {
  text: string
  names: string[]
}
export interface Field {
  name: string
  required: boolean
  type: TypeText
  text: string
}
export interface Route {
  id: string
  method: string
  path: string
  summary: string
  description: string
  parameters: (Field & { place: string })[]
  body?: { media: string; type: TypeText }
  answers: { status: string; text: string; media: string; type: TypeText }[]
  command: string
}
export interface Group {
  name: string
  text: string
  routes: Route[]
}
/** A named schema: its fields, or the forms of which it is one. */
export interface Shape {
  name: string
  text: string
  type: TypeText
  forms: { text: string; fields: Field[] }[]
}

const NOTHING: TypeText = { text: '', names: [] }

const join = (parts: TypeText[], between: string): TypeText => ({
  text: parts.map(({ text }) => text).join(between),
  names: [...new Set(parts.flatMap(({ names }) => names))],
})

/** What may stand there, in words. */
export function typeText(schema: Schema | undefined): TypeText {
  if (!schema) return NOTHING
  if (schema.$ref) {
    const name = schema.$ref.split('/').pop() ?? ''
    return { text: name, names: [name] }
  }
  if (schema.enum) return { text: schema.enum.map((value) => JSON.stringify(value)).join(' | '), names: [] }
  const some = schema.oneOf ?? schema.anyOf
  if (some) return join(some.map(typeText), ' | ')
  if (schema.allOf) return join(schema.allOf.map(typeText), ' & ')
  const kinds = [schema.type ?? 'anything'].flat()
  if (kinds.includes('array')) {
    const inner = schema.prefixItems ? join(schema.prefixItems.map(typeText), ', ') : typeText(schema.items)
    const list = { text: `list of ${inner.text || 'anything'}`, names: inner.names }
    return kinds.includes('null') ? { text: `${list.text} | null`, names: list.names } : list
  }
  if (kinds.includes('object') && typeof schema.additionalProperties === 'object') {
    const inner = typeText(schema.additionalProperties)
    return { text: `map from names to ${inner.text}`, names: inner.names }
  }
  return { text: kinds.join(' | '), names: [] }
}

/** The members of an object, those that must be there first. */
export function fields(schema: Schema): Field[] {
  const must = new Set(schema.required)
  return Object.entries(schema.properties ?? {})
    .map(([name, value]) => ({ name, required: must.has(name), type: typeText(value), text: value.description ?? '' }))
    .toSorted((a, b) => Number(b.required) - Number(a.required) || a.name.localeCompare(b.name))
}

/** The command line that asks the same of the service at `origin`. */
export function command(origin: string, method: string, path: string, operation: Operation): string {
  const needed = operation.parameters?.filter(({ in: place, required }) => place === 'query' && required) ?? []
  const query = needed.map(({ name }) => `${name}=${name.toUpperCase()}`).join('&')
  const address = `${origin}${path.replace(/\{(\w+)\}/g, (_, name: string) => name.toUpperCase())}${query && `?${query}`}`
  const [media, content] = Object.entries(operation.requestBody?.content ?? {})[0] ?? []
  const parts = ['curl']
  if (method !== 'get') parts.push(`-X ${method.toUpperCase()}`)
  if (media === 'multipart/form-data') parts.push('-F file=@FILE')
  else if (media === 'application/json') {
    const example = content?.example ?? content?.schema?.example
    parts.push(`-H 'Content-Type: application/json' -d '${example === undefined ? '{…}' : JSON.stringify(example)}'`)
  } else if (media) parts.push('--data-binary @FILE')
  return `${parts.join(' ')} '${address}'`
}

function route(origin: string, path: string, method: string, operation: Operation): Route {
  const [media, content] = Object.entries(operation.requestBody?.content ?? {})[0] ?? []
  return {
    id: operation.operationId,
    method: method.toUpperCase(),
    path,
    summary: operation.summary ?? '',
    description: operation.description ?? '',
    parameters: (operation.parameters ?? []).map((p) => ({
      name: p.name,
      place: p.in,
      required: p.required ?? false,
      type: typeText(p.schema),
      text: p.description ?? p.schema?.description ?? '',
    })),
    ...(media && { body: { media, type: typeText(content?.schema) } }),
    answers: Object.entries(operation.responses).map(([status, answer]) => {
      const [kind, said] = Object.entries(answer.content ?? {})[0] ?? ['', undefined]
      return { status, text: answer.description ?? '', media: kind, type: typeText(said?.schema) }
    }),
    command: command(origin, method, path, operation),
  }
}

/** Routes by subject, in the document's order of subjects. */
export function groups(document: Document, origin: string): Group[] {
  const routes = Object.entries(document.paths).flatMap(([path, methods]) =>
    Object.entries(methods).map(([method, operation]) => ({ tag: operation.tags?.[0] ?? '', route: route(origin, path, method, operation) })),
  )
  const named = document.tags ?? []
  const others = [...new Set(routes.map(({ tag }) => tag))].filter((tag) => !named.some(({ name }) => name === tag))
  return [...named, ...others.map((name) => ({ name, description: '' }))]
    .map(({ name, description }) => ({
      name,
      text: description ?? '',
      routes: routes.filter(({ tag }) => tag === name).map(({ route: one }) => one),
    }))
    .filter(({ routes: some }) => some.length > 0)
}

/** Every named schema, by name. */
export function shapes(document: Document): Shape[] {
  const named = Object.entries(document.components?.schemas ?? {}).toSorted(([a], [b]) => a.localeCompare(b))
  return named.map(([name, schema]) => {
    const forms = (schema.oneOf ?? [schema]).filter(({ properties }) => properties)
    return {
      name,
      text: schema.description ?? '',
      type: forms.length > 0 ? NOTHING : typeText(schema),
      forms: forms.map((form) => ({ text: form === schema ? '' : (form.description ?? ''), fields: fields(form) })),
    }
  })
}
