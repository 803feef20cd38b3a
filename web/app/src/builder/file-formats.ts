import type { ObjectInfo } from '../api/types'
import { significant } from '../ui/format'
import { find } from './objects'

type Format = NonNullable<ObjectInfo['format']>

/** The formats that the service reads: name and usual ending. The service decides by the content alone. */
const FORMATS: Record<Format, { name: string; ending: string }> = {
  obj: { name: 'OBJ', ending: '.obj' },
  stl: { name: 'STL', ending: '.stl' },
  ply: { name: 'PLY', ending: '.ply' },
  off: { name: 'OFF', ending: '.off' },
  gltf: { name: 'glTF', ending: '.gltf' },
  glb: { name: 'GLB', ending: '.glb' },
  collada: { name: 'COLLADA', ending: '.dae' },
}

/** As a sentence names them: "OBJ, STL, ... or COLLADA". */
export const FORMAT_NAMES = Object.values(FORMATS).map(({ name }) => name).join(', ').replace(/, (\w+)$/, ' or $1')

/** For the `accept` of a file input. */
export const ACCEPTED = [...Object.values(FORMATS).map(({ ending }) => ending), 'model/*', 'text/plain'].join()

/** A name that the file of an uploaded object may have had. */
export function objectFile({ name, format }: Pick<ObjectInfo, 'name' | 'format'>): string {
  const { ending } = FORMATS[format ?? 'obj']
  return name.toLowerCase().endsWith(ending) ? name : name + ending
}

/** What a command names for an object: the id of a stock object, or the file of an uploaded one. `name`: where it is not listed. */
export function commandFile(objects: readonly ObjectInfo[], id: string, name = 'object'): string {
  return id.startsWith('stock:') ? id : objectFile(find(objects, id) ?? { name })
}

/** Format and unit of the file of an object: "COLLADA, in inch (0.0254 m)"; empty where neither is known. */
export function fileOf({ format, unit }: Pick<ObjectInfo, 'format' | 'unit'>): string {
  const length = unit && (unit.metres === 1 ? 'in metres' : `in ${unit.name} (${significant(unit.metres)} m)`)
  return [format && FORMATS[format].name, length].filter(Boolean).join(', ')
}
