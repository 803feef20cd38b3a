import { computed, type ComputedRef } from 'vue'

/** A list that stays the same object while its entries have the same fields, so that what shows it has nothing to do. */
export function steadyList<T extends object>(list: () => T[]): ComputedRef<T[]> {
  return computed<T[]>((old) => {
    const now = list()
    const same = old?.length === now.length && now.every((entry, i) => sameFields(entry, old[i]))
    return same && old ? old : now
  })
}

function sameFields<T extends object>(entry: T, old: T | undefined): boolean {
  return old !== undefined && (Object.keys(entry) as (keyof T)[]).every((field) => entry[field] === old[field])
}
