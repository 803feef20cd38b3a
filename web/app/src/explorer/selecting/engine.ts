import { tableFromIPC } from '@uwdata/flechette'
import { RADIUS, thinned, within, type Cloud } from '../cloud/density'
import { apply, ascending, axis, counted, litVertices, places, sortedChosen, type Axis, type Columns } from './apply'
import { algorithms, parse, type Column } from './language'

/** An object's surface as far as selections need it. */
export interface SurfaceData {
  positions: Float32Array
  corners: Uint32Array | Uint16Array
  /** Longest side of its box. */
  longest: number
}

/** What the page wants to know. */
export interface Question {
  /** All of it must hold; empty: nothing is selected. */
  where: string[]
  /** The algorithm of the chart, whose columns are meant when none is named. */
  lookedAt: string
  side: 'a' | 'b'
  /** Whether the closest points are shown. */
  points: boolean
  /** The column across the time, or the first that can be had. */
  y: Column | null
  cells: [number, number]
  /** Algorithms of the table and of the distribution. */
  algorithms: string[]
}

export interface SelectedTimes {
  algorithm: string
  n: number
  median: number | null
  p99: number | null
  max: number | null
  /** Points of the distribution of the selected times. */
  times: number[]
  share: number[]
}

export interface Answer {
  /** Configurations in the set. */
  of: number
  /** Selected ones; null without a selection. */
  n: number | null
  /** Members of every selection by itself. */
  each: number[]
  lit: Float32Array<ArrayBuffer> | null
  chart: { x: Axis; y: Axis; column: Column; all: Uint32Array<ArrayBuffer>; lit: Uint32Array<ArrayBuffer> } | null
  /** Columns that may stand across the time. */
  columns: Column[]
  rows: SelectedTimes[]
  /** The closest points on the object, when they are asked for. */
  cloud: Cloud | null
  /** Per point of the cloud, whether its configuration is selected; null without a selection. */
  cloudChosen: Uint8Array | null
}

const ACROSS: readonly Column[] = ['bv', 'primitives', 'error', 'distance']
const POINTS = 256

type Numbers = Record<string, ArrayLike<number>>
interface ChartOfAll { key: string; x: Axis; y: Axis; at: Int32Array }

/** The configurations of one run, in columns; fetched when first asked for. Runs in a worker. */
export class Selecting {
  private readonly fetched = new Map<string, Promise<Numbers>>()
  private readonly loaded = new Map<string, Numbers>()
  /** What stays the same from question to question: who is where in the chart, who is how fast among all. */
  private chartOfAll: ChartOfAll | null = null
  private readonly clouds = new Map<string, Cloud>()
  private readonly orders = new Map<string, Uint32Array>()

  constructor(
    private readonly run: string,
    private readonly surfaces: { a: SurfaceData; b: SurfaceData },
  ) {}

  async answer(question: Question): Promise<Answer> {
    const predicates = question.where.map(parse)
    const needed = predicates.flatMap((one) => algorithms(one, question.lookedAt))
    const rows = predicates.length > 0 ? question.algorithms : []
    await this.have([question.lookedAt, ...needed, ...rows])
    const columns = this.view(question.lookedAt)
    return this.answered(question, rows, columns, predicates.map((one) => apply(one, columns)))
  }

  /** Does what any selection needs, so that the first one is answered as soon as the others. */
  async prepare(question: Question): Promise<void> {
    await this.have([question.lookedAt, ...question.algorithms])
    const all = new Uint8Array(this.known('').distance?.length ?? 0).fill(1)
    this.answered(question, question.algorithms, this.view(question.lookedAt), [all])
  }

  private answered(question: Question, rows: string[], columns: Columns, masks: Uint8Array[]): Answer {
    const of = this.known('').distance?.length ?? 0
    const chosen = masks.length > 0 ? masks.reduce((x, y) => x.map((is, i) => is & (y[i] ?? 0))) : null
    const surface = this.surfaces[question.side]
    const triangles = this.known('')[`triangle_${question.side}`]
    const cloud = question.points ? this.cloud(question.side) : null
    const across = ACROSS.filter((column) => column === 'distance' || column in this.known(question.lookedAt))
    return {
      of,
      n: chosen && sum(chosen),
      each: masks.map(sum),
      lit: chosen && triangles ? litVertices(chosen, triangles, surface.corners, surface.positions.length / 3) : null,
      chart: this.chart(question, across, columns, chosen),
      columns: across,
      rows: chosen ? rows.map((algorithm) => this.times(algorithm, columns.column('time', algorithm), chosen)) : [],
      cloud,
      cloudChosen: cloud && chosen ? Uint8Array.from(cloud.records, (record) => chosen[record] ?? 0) : null,
    }
  }

  private chart({ y: wanted, cells, lookedAt }: Question, across: Column[], columns: Columns, chosen: Uint8Array | null) {
    const column = across.find((one) => one === wanted) ?? across[0]
    if (!column || !this.known(lookedAt).time) return null
    const key = JSON.stringify([lookedAt, column, cells])
    if (this.chartOfAll?.key !== key) {
      const [xs, ys] = [columns.column('time', null), columns.column(column, null)]
      const axes = { x: axis(xs, cells[0]), y: axis(ys, cells[1]) }
      this.chartOfAll = { key, ...axes, at: places(xs, ys, axes.x, axes.y) }
    }
    const { x, y, at } = this.chartOfAll
    const count = (which: Uint8Array | null) => counted(at, x.cells * y.cells, which)
    return { x, y, column, all: count(null), lit: chosen ? count(chosen) : new Uint32Array(x.cells * y.cells) }
  }

  private cloud(side: 'a' | 'b'): Cloud {
    const known = this.clouds.get(side)
    if (known) return known
    const [x, y, z] = this.points(side)
    const points = thinned(x, y, z)
    const cloud = { side, ...points, near: within(points.positions, RADIUS * this.surfaces[side].longest) }
    this.clouds.set(side, cloud)
    return cloud
  }

  /** The witness points on an object, by axes. */
  private points(side: 'a' | 'b'): [ArrayLike<number>, ArrayLike<number>, ArrayLike<number>] {
    const along = (axisName: string) => this.known('')[`${side}_${axisName}`] ?? []
    return [along('x'), along('y'), along('z')]
  }

  private times(algorithm: string, values: ArrayLike<number>, chosen: Uint8Array): SelectedTimes {
    const order = this.orders.get(algorithm) ?? ascending(values)
    this.orders.set(algorithm, order)
    return times(algorithm, sortedChosen(values, order, chosen))
  }

  private view(lookedAt: string): Columns {
    return {
      column: (column, of) => {
        const values = column === 'distance' ? this.known('').distance : this.known(of ?? lookedAt)[column]
        if (!values) throw new Error(`${of ?? lookedAt} has no column "${column}" in this run.`)
        return values
      },
      fromVertex: (body, vertex) => {
        const { positions, longest } = this.surfaces[body]
        if (3 * vertex >= positions.length) throw new Error(`Object ${body.toUpperCase()} has no vertex ${vertex}.`)
        const [x, y, z] = this.points(body)
        const [cx = 0, cy = 0, cz = 0] = positions.subarray(3 * vertex, 3 * vertex + 3)
        const distances = new Float64Array(x.length)
        for (let i = 0; i < distances.length; i++) {
          const dx = (x[i] ?? 0) - cx
          const dy = (y[i] ?? 0) - cy
          const dz = (z[i] ?? 0) - cz
          distances[i] = Math.sqrt(dx * dx + dy * dy + dz * dz) / longest
        }
        return distances
      },
    }
  }

  private known(key: string): Numbers {
    return this.loaded.get(key) ?? {}
  }

  /** Witness points, and the columns of these algorithms. */
  private async have(ids: string[]): Promise<void> {
    const columns = [...new Set(ids)].map((id) => this.fetch(id, `columns.arrow?${new URLSearchParams({ algorithm: id })}`))
    await Promise.all([this.fetch('', 'witnesses.arrow'), ...columns])
  }

  private fetch(key: string, what: string): Promise<Numbers> {
    const known = this.fetched.get(key)
    if (known) return known
    const coming = fetchColumns(`/api/v1/runs/${encodeURIComponent(this.run)}/${what}`).then((numbers) => {
      this.loaded.set(key, numbers)
      return numbers
    })
    // What could not be fetched is asked for again the next time.
    coming.catch(() => this.fetched.delete(key))
    this.fetched.set(key, coming)
    return coming
  }
}

async function fetchColumns(url: string): Promise<Numbers> {
  const response = await fetch(url)
  if (!response.ok) {
    const problem = (await response.json().catch(() => null)) as { detail?: string } | null
    throw new Error(problem?.detail ?? `The service answered ${response.status}.`)
  }
  const table = tableFromIPC(await response.arrayBuffer())
  return Object.fromEntries(table.names.map((name) => [String(name), table.getChild(name).toArray() as ArrayLike<number>]))
}

const sum = (mask: Uint8Array): number => mask.reduce((n, is) => n + is, 0)

function times(algorithm: string, sorted: Float64Array): SelectedTimes {
  const n = sorted.length
  const at = (q: number) => (n > 0 ? (sorted[Math.round(q * (n - 1))] ?? null) : null)
  const points = Math.min(n, POINTS)
  const indices = Array.from({ length: points }, (_, i) => Math.round((i * (n - 1)) / Math.max(1, points - 1)))
  return {
    algorithm, n, median: at(0.5), p99: at(0.99), max: at(1),
    times: indices.map((i) => sorted[i] ?? 0), share: indices.map((i) => (i + 1) / n),
  }
}
