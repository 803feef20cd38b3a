import { expect, it } from 'vitest'
import { isSoftware } from './software'

it.each([
  ['ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)', true],
  ['llvmpipe (LLVM 15.0.6, 256 bits)', true],
  ['ANGLE (NVIDIA, NVIDIA GeForce RTX 4070 Direct3D11)', false],
  ['Apple M2', false],
])('%s', (name, software) => expect(isSoftware(name)).toBe(software))
