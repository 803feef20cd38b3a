import type { BodyKind, ReducedScene, ReduceTerms } from '../api/types'
import { quote } from '../builder/command-line'
import { count, significant } from '../ui/format'

/** What stands for an object. */
export const BODY: Record<BodyKind, string> = {
  object: 'the object itself', sphere: 'a sphere', capsule: 'a capsule', box: 'a box', hull: 'its convex hull', hulls: 'convex hulls of a few parts', level: 'a mesh with fewer triangles',
}

const sum = (scene: ReducedScene, of: 'before' | 'after') => scene.objects.reduce((all, object) => all + object[of], 0)

/** How much smaller the scene became, and what that is worth. */
export function savedWords(scene: ReducedScene): string {
  const faster = (scene.speed ?? []).flatMap(({ algorithm, faster: range }) => (range ? [{ algorithm, least: Math.min(...range) }] : [])).toSorted((a, b) => b.least - a.least)[0]
  const gain = faster ? ` ${faster.algorithm} gains most: its queries are at least ${significant(faster.least)} times as fast.` : ''
  return `${count(sum(scene, 'before'))} elements became ${count(sum(scene, 'after'))}.${gain}`
}

/** What is certified. */
export function certifiedWords(scene: ReducedScene): string {
  const around = scene.near > 0 ? `, and wherever one object is moved relative to the other by less than ${scene.near}` : ''
  const which = `Certified for each of ${count(scene.queries)} recorded queries${around}: the answer is right for a distance within ${scene.tolerance} of the true one.`
  const missed = scene.outside_only
    ? 'Every body contains its object, so no collision is missed, recorded or not.'
    : `Of ${count(scene.hits)} recorded collisions, ${count(scene.grazing)} became gaps smaller than that.`
  return `${which} ${missed}`
}

/** How far the choice holds for queries that it has not seen. */
export function laterWords({ held_out: later, near }: ReducedScene): string {
  if (!later) return 'The recording is too short to leave a part of it out.'
  const { changed } = later
  const share = (x: number) => `${significant(100 * x)} %`
  const of = changed.of > 0 ? changed.seen / changed.of : 0
  const told = `Chosen without the last ${count(later.queries)} queries, the bodies change ${count(changed.seen)} of these by more than the tolerance: ${share(of)} [${share(changed.lo)}, ${share(changed.hi)}]; ${count(later.missed)} of them are missed collisions.`
  if (changed.seen === 0) return told
  return `${told} So queries that were not recorded are not covered${near > 0 ? ' outside of the neighbourhoods' : '; a neighbourhood would cover more of them'}.`
}

/** The same on the command line. */
export function reduceCommand(file: string, terms: ReduceTerms, algorithms: readonly string[]): string {
  return [
    `ocb scene reduce ${quote(file)}`,
    `--tolerance ${terms.tolerance}`,
    ...(terms.near ? [`--near ${terms.near}`] : []),
    ...(terms.outside_only ? ['--outside-only'] : []),
    ...(terms.frontier ? ['--frontier'] : []),
    ...(algorithms.length > 0 ? [`--algorithm ${algorithms.map(quote).join(',')}`] : []),
    '--out reduced',
  ].join(' \\\n  ')
}
