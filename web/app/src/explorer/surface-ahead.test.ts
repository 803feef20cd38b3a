import { afterEach, expect, it, vi } from 'vitest'
import { fetchAhead, takeMesh } from './surface-ahead'

afterEach(() => vi.unstubAllGlobals())

function serve(...statuses: number[]) {
  const asked: string[] = []
  vi.stubGlobal('fetch', async (url: string) => {
    asked.push(url)
    return new Response('mesh', { status: statuses[asked.length - 1] ?? 200 })
  })
  return asked
}

it('fetches a surface once, whether it is drawn before or after it has arrived', async () => {
  const asked = serve()
  fetchAhead('a')
  fetchAhead('a')
  expect((await takeMesh('a')).byteLength).toBe(4)
  expect(asked).toHaveLength(1)
  await takeMesh('a')
  expect(asked).toHaveLength(2)
})

it('asks again when the first request failed or was for another object', async () => {
  const asked = serve(503)
  fetchAhead('a')
  expect((await takeMesh('a')).byteLength).toBe(4)
  fetchAhead('a')
  await takeMesh('b')
  expect(asked.map((url) => url.at(-'/mesh.glb'.length - 1))).toEqual(['a', 'a', 'a', 'b'])
})
