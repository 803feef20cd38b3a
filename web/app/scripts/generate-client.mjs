// Writes src/api/schema.d.ts from the service's OpenAPI document; with --check it only says whether the file is stale.
import { readFile, writeFile } from 'node:fs/promises'
import { fileURLToPath } from 'node:url'
import openapiTS, { astToString } from 'openapi-typescript'

const document = new URL('../../server/openapi.json', import.meta.url)
const target = new URL('../src/api/schema.d.ts', import.meta.url)

const head = '// Generated from web/server/openapi.json by `npm run generate`: do not edit.\n'
const wanted = head + astToString(await openapiTS(JSON.parse(await readFile(document, 'utf8'))))

if (process.argv.includes('--check')) {
  const found = await readFile(target, 'utf8').catch(() => '')
  if (found !== wanted) {
    console.error(`${fileURLToPath(target)} is not what web/server/openapi.json says: run \`npm run generate\`.`)
    process.exit(1)
  }
} else {
  await writeFile(target, wanted)
}
