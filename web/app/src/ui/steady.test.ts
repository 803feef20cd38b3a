import { expect, it } from 'vitest'
import { ref } from 'vue'
import { steadyList } from './steady'

it('is another list only when an entry has another field or there are more', () => {
  const source = ref([{ id: 'a', n: 1 }])
  const list = steadyList(() => source.value.map((entry) => ({ ...entry })))
  const first = list.value
  source.value = [{ id: 'a', n: 1 }]
  expect(list.value).toBe(first)
  source.value = [{ id: 'a', n: 2 }]
  expect(list.value).toEqual([{ id: 'a', n: 2 }])
  source.value = [{ id: 'a', n: 2 }, { id: 'b', n: 2 }]
  expect(list.value).toHaveLength(2)
})
