/** What draws on this machine. */
export interface Graphics {
  available: boolean
  /** A processor draws, not a graphics card: then no multisampling, and half resolution while the camera moves. */
  software: boolean
}

let known: Graphics | undefined

/** Asks once, with a context that is given back at once. */
export function graphics(): Graphics {
  known ??= probe()
  return known
}

function probe(): Graphics {
  const gl = document.createElement('canvas').getContext('webgl2')
  if (!gl) return { available: false, software: false }
  const info = gl.getExtension('WEBGL_debug_renderer_info')
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER))
  gl.getExtension('WEBGL_lose_context')?.loseContext()
  return { available: true, software: isSoftware(name) }
}

/** Whether a renderer's name is that of a software renderer. */
export function isSoftware(name: string): boolean {
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name)
}
