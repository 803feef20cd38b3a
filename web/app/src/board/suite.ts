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

/** Missing results, and when they will be measured; null when none are missing. */
export function missingWords({ progress, idle }: Pick<SuiteInfo, 'progress' | 'idle'>): string | null {
  const sum = (of: (one: SuiteProgress) => number) => progress.reduce((all, one) => all + of(one), 0)
  const [missing, failed] = [sum(({ of, measured }) => of - measured), sum((one) => one.failed)]
  if (missing === 0) return null
  const results = (n: number) => `${n} ${n === 1 ? 'result' : 'results'}`
  const said = [`${results(missing)} of the suite ${missing === 1 ? 'is' : 'are'} missing here.`]
  if (failed > 0) said.push(`${failed} of them could not be measured and will not be tried again automatically.`)
  if (missing > failed) {
    const rest = failed > 0 ? 'The others' : missing === 1 ? 'It' : 'They'
    const one = failed === 0 && missing === 1
    said.push(idle ? `${rest} will be measured when this service is idle.` : `${rest} ${one ? 'is' : 'are'} not measured automatically: filling the suite while idle is turned off.`)
  }
  return said.join(' ')
}

/** Who is not through with the suite: nothing measured yet, or a part. */
export function unfinished(progress: readonly SuiteProgress[]): SuiteProgress[] {
  return progress.filter(({ measured, of }) => measured < of)
}
