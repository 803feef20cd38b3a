// Writes src/api/schema.d.ts from the service's OpenAPI document, unless it is current. Types alone: what is built needs none of it.
import { readFile, writeFile } from 'node:fs/promises'
import openapiTS, { astToString } from 'openapi-typescript'

const document = new URL('../../server/openapi.json', import.meta.url)
const target = new URL('../src/api/schema.d.ts', import.meta.url)

const head = '// Generated from web/server/openapi.json by `npm run generate`: do not edit.\n'
const wanted = head + astToString(await openapiTS(JSON.parse(await readFile(document, 'utf8'))))
const found = await readFile(target, 'utf8').catch(() => '')
if (found !== wanted) await writeFile(target, wanted)
