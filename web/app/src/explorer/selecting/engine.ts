import { tableFromIPC } from '@uwdata/flechette'
import { RADIUS, thinned, within, type Cloud } from '../cloud/density'
import { ascending, axis, counted, litVertices, places, sortedChosen, type Axis } from './counting'

/** An object's surface as far as selections need it. */
export interface SurfaceData {
  positions: Float32Array
  corners: Uint32Array | Uint16Array
  /** Longest side of its box. */
  longest: number
  /** From where the positions count; absent: from the origin. */
  origin?: readonly [number, number, number]
}

/** A number that every configuration has, and that a range can test. */
export interface Column {
  /** Its name in selections. */
  name: string
  /** What an axis is called that shows it. */
  axis: string
  unit: string
  /** The same for every algorithm. */
  shared: boolean
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
  /** The name of the column across the time, or the first that can be had. */
  y: string | null
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

const POINTS = 256
/** Selections of which it is known what they hold; those that were asked for longest ago are forgotten. */
const MOST_MASKS = 64

interface Table { columns: Column[]; numbers: Record<string, ArrayLike<number>> }
const EMPTY: Table = { columns: [], numbers: {} }
interface ChartOfAll { key: string; x: Axis; y: Axis; at: Int32Array }

/** The configurations of one run, in columns; fetched when first asked for. Runs in a worker. */
export class Selecting {
  private readonly fetched = new Map<string, Promise<Table>>()
  private readonly loaded = new Map<string, Table>()
  private readonly masks = new Map<string, Promise<Uint8Array>>()
  /** What stays the same from question to question: who is where in the chart, who is how fast among all. */
  private chartOfAll: ChartOfAll | null = null
  private readonly clouds = new Map<string, Cloud>()
  private readonly orders = new Map<string, Uint32Array>()

  constructor(
    private readonly run: string,
    private readonly surfaces: { a: SurfaceData; b: SurfaceData },
  ) {}

  async answer(question: Question): Promise<Answer> {
    const { where, lookedAt } = question
    const rows = where.length > 0 ? question.algorithms : []
    const [masks] = await Promise.all([Promise.all(where.map((one) => this.mask(one, lookedAt))), this.have([lookedAt, ...rows])])
    return this.answered(question, rows, masks)
  }

  /** Does what any selection needs, so that the first one is answered as soon as the others. */
  async prepare(question: Question): Promise<void> {
    await this.have([question.lookedAt, ...question.algorithms])
    const all = new Uint8Array(this.known('').distance?.length ?? 0).fill(1)
    this.answered(question, question.algorithms, [all])
  }

  private answered(question: Question, rows: string[], masks: Uint8Array[]): Answer {
    const of = this.known('').distance?.length ?? 0
    const chosen = masks.length > 0 ? masks.reduce((x, y) => x.map((is, i) => is & (y[i] ?? 0))) : null
    const surface = this.surfaces[question.side]
    const triangles = this.known('')[`triangle_${question.side}`]
    const cloud = question.points ? this.cloud(question.side) : null
    const columns = [question.lookedAt, ''].flatMap((key) => this.table(key).columns).filter(({ name }) => name !== 'time')
    return {
      of,
      n: chosen && sum(chosen),
      each: masks.map(sum),
      lit: chosen && triangles ? litVertices(chosen, triangles, surface.corners, surface.positions.length / 3) : null,
      chart: this.chart(question, columns, chosen),
      columns,
      rows: chosen ? rows.map((algorithm) => this.times(algorithm, this.known(algorithm).time ?? [], chosen)) : [],
      cloud,
      cloudChosen: cloud && chosen ? Uint8Array.from(cloud.records, (record) => chosen[record] ?? 0) : null,
    }
  }

  private chart({ y: wanted, cells, lookedAt }: Question, columns: Column[], chosen: Uint8Array | null) {
    const column = columns.find(({ name }) => name === wanted) ?? columns[0]
    const xs = this.known(lookedAt).time
    const ys = column && this.known(column.shared ? '' : lookedAt)[column.name]
    if (!column || !xs || !ys) return null
    const key = JSON.stringify([lookedAt, column.name, cells])
    if (this.chartOfAll?.key !== key) {
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

  /** The witness points on an object, by axes; they count from where its positions do. */
  private points(side: 'a' | 'b'): [ArrayLike<number>, ArrayLike<number>, ArrayLike<number>] {
    const [x0, y0, z0] = this.surfaces[side].origin ?? [0, 0, 0]
    const along = (axisName: string, from: number) => {
      const values = this.known('')[`${side}_${axisName}`] ?? []
      return from === 0 ? values : Float64Array.from(values, (value) => value - from)
    }
    return [along('x', x0), along('y', y0), along('z', z0)]
  }

  private times(algorithm: string, values: ArrayLike<number>, chosen: Uint8Array): SelectedTimes {
    const order = this.orders.get(algorithm) ?? ascending(values)
    this.orders.set(algorithm, order)
    return times(algorithm, sortedChosen(values, order, chosen))
  }

  private table(key: string): Table {
    return this.loaded.get(key) ?? EMPTY
  }

  private known(key: string): Table['numbers'] {
    return this.table(key).numbers
  }

  /** Which configurations a selection holds, 1 or 0 each: the service reads it, so the page need not know its language. */
  private mask(where: string, lookedAt: string): Promise<Uint8Array> {
    const query = String(new URLSearchParams({ algorithm: lookedAt, where }))
    const known = this.masks.get(query)
    if (known) return known
    const coming = this.fetchTable(`selection.arrow?${query}`).then(({ numbers }) => Uint8Array.from(numbers.chosen ?? [], Number))
    coming.catch(() => this.masks.delete(query))
    this.masks.set(query, coming)
    for (const oldest of this.masks.keys()) if (this.masks.size > MOST_MASKS) this.masks.delete(oldest)
    return coming
  }

  /** Witness points, and the columns of these algorithms. */
  private async have(ids: string[]): Promise<void> {
    const columns = [...new Set(ids)].map((id) => this.fetch(id, `columns.arrow?${new URLSearchParams({ algorithm: id })}`))
    await Promise.all([this.fetch('', 'witnesses.arrow'), ...columns])
  }

  private fetch(key: string, what: string): Promise<Table> {
    const known = this.fetched.get(key)
    if (known) return known
    const coming = this.fetchTable(what, key === '').then((table) => {
      this.loaded.set(key, table)
      return table
    })
    // What could not be fetched is asked for again the next time.
    coming.catch(() => this.fetched.delete(key))
    this.fetched.set(key, coming)
    return coming
  }

  private async fetchTable(what: string, shared = false): Promise<Table> {
    const response = await fetch(`/api/v1/runs/${encodeURIComponent(this.run)}/${what}`)
    if (!response.ok) {
      const problem = (await response.json().catch(() => null)) as { detail?: string } | null
      throw new Error(problem?.detail ?? `The service answered ${response.status}.`)
    }
    const table = tableFromIPC(await response.arrayBuffer())
    // What has no axis, such as the triangles, is no column of selections; its metadata are null, whatever the type says.
    const columns = table.schema.fields
      .map(({ name, metadata }) => ({ name, of: new Map(metadata) }))
      .map(({ name, of }) => ({ name, axis: of.get('axis') ?? '', unit: of.get('unit') ?? '', shared }))
      .filter((column) => column.axis !== '')
    const numbers = table.names.map((name) => [name, table.getChild(name).toArray() as ArrayLike<number>] as const)
    return { columns, numbers: Object.fromEntries(numbers) }
  }
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
