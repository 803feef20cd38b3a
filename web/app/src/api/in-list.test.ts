import { QueryClient, QueryObserver } from '@tanstack/vue-query'
import { expect, test } from 'vitest'
import { putInList } from './in-list'

test('what is new stays in a list whose answer comes later', async () => {
  const cache = new QueryClient()
  let answer: (list: string[]) => void = () => {}
  const asked: number[] = []
  const queryFn = () => {
    asked.push(1)
    return new Promise<string[]>((done) => { answer = done })
  }
  const stop = new QueryObserver(cache, { queryKey: ['objects'], queryFn }).subscribe(() => {})
  const put = (name: string) => putInList<string>(cache, 'objects', (old) => [...old.filter((known) => known !== name), name])
  const late = put('mine')
  expect(cache.getQueryData(['objects'])).toEqual(['mine'])
  answer(['bunny', 'dragon'])
  await late
  expect(cache.getQueryData(['objects'])).toEqual(['bunny', 'dragon', 'mine'])
  await put('another')
  await put('mine')
  expect(cache.getQueryData(['objects'])).toEqual(['bunny', 'dragon', 'another', 'mine'])
  expect(asked).toHaveLength(1)
  stop()
})
