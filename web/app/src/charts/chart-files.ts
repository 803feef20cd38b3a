import { fileName, save } from '../ui/save'

/** Pixels of the picture for one of the drawing. */
const SCALE = 2

/** Hands the drawing to the reader, as it is or as pixels on the page's paper. */
export async function saveDrawing(source: string, name: string, kind: 'svg' | 'png', paper: string): Promise<void> {
  const drawing = new Blob([source], { type: 'image/svg+xml' })
  save(kind === 'svg' ? drawing : await pixels(drawing, paper), fileName(`${name}.${kind}`))
}

async function pixels(drawing: Blob, paper: string): Promise<Blob> {
  const address = URL.createObjectURL(drawing)
  try {
    const image = new Image()
    image.src = address
    await image.decode()
    const canvas = document.createElement('canvas')
    canvas.width = image.naturalWidth * SCALE
    canvas.height = image.naturalHeight * SCALE
    const context = canvas.getContext('2d')
    if (!context) throw new Error('This browser cannot draw the picture.')
    context.fillStyle = paper
    context.fillRect(0, 0, canvas.width, canvas.height)
    context.drawImage(image, 0, 0, canvas.width, canvas.height)
    return await new Promise((resolve, reject) =>
      canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('This browser cannot write PNG.'))), 'image/png'),
    )
  } finally {
    URL.revokeObjectURL(address)
  }
}
