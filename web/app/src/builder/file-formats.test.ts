import { expect, test } from 'vitest'
import type { ObjectInfo } from '../api/types'
import { ACCEPTED, FORMAT_NAMES, commandFile, fileOf, objectFile } from './file-formats'

test('the formats as a sentence and as a filter of files', () => {
  expect(FORMAT_NAMES).toBe('OBJ, STL, PLY, OFF, glTF, GLB or COLLADA')
  expect(ACCEPTED).toBe('.obj,.stl,.ply,.off,.gltf,.glb,.dae,model/*,text/plain')
})

test('a file is named for its format', () => {
  expect(objectFile({ name: 'gear', format: 'collada' })).toBe('gear.dae')
  expect(objectFile({ name: 'gear.STL', format: 'stl' })).toBe('gear.STL')
  expect(objectFile({ name: 'old' })).toBe('old.obj')
})

test('a command names the file of the format that was uploaded, and stock objects by their ids', () => {
  const objects = [{ id: 'u1', name: 'gear', format: 'stl' } as ObjectInfo]
  expect(commandFile(objects, 'u1')).toBe('gear.stl')
  expect(commandFile(objects, 'stock:box@500')).toBe('stock:box@500')
  expect(commandFile(objects, 'gone', 'wheel')).toBe('wheel.obj')
})

test('format and unit are said as far as they are known', () => {
  expect(fileOf({ format: 'collada', unit: { name: 'inch', metres: 0.0254 } })).toBe('COLLADA, in inch (0.0254 m)')
  expect(fileOf({ format: 'glb', unit: { name: 'meter', metres: 1 } })).toBe('GLB, in metres')
  expect(fileOf({ format: 'stl' })).toBe('STL')
  expect(fileOf({})).toBe('')
})
