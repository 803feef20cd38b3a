import type { Separation, SuiteInfo, SuiteProgress } from '../api/types'
import { QUERY } from '../ui/words'

/** What a suite asks, in words: its scenes, distances and questions. */
export function describeSuite({ scenes, separations, queries }: Pick<SuiteInfo, 'scenes' | 'separations' | 'queries'>): Record<'scenes' | 'distances' | 'questions', string> {
  const name = (id: string | undefined) => (id ?? '').replace('stock:', '')
  const scene = ([a, b]: readonly string[]) => (a === b ? `${name(a)} against itself` : `${name(a)} against ${name(b)}`)
  return {
    scenes: scenes.map(scene).join('; '),
    distances: separations.map(describe).join('; '),
    questions: queries.map((query) => QUERY[query]).join('; '),
  }
}

function describe(separation: Separation): string {
  if (separation.kind === 'ladder') return 'the ladder of steps, apart and crossing'
  if (separation.kind === 'step') return `step ${separation.of_size.toExponential()} of the scene’s size`
  return `relative distance ${separation.distance}`
}

/** Who is not through with the suite: nothing measured yet, or a part. */
export function unfinished(progress: readonly SuiteProgress[]): SuiteProgress[] {
  return progress.filter(({ measured, of }) => measured < of)
}
