import { Selecting, type Answer, type Question, type SurfaceData } from './engine'

/** The page speaks first with the run and its surfaces, then asks; every question gets one reply with its number. */
export type Message =
  | { kind: 'open'; run: string; a: SurfaceData; b: SurfaceData }
  | { kind: 'ask'; number: number; question: Question }
export type Reply = { number: number } & ({ answer: Answer } | { error: string })

let selecting: Selecting | null = null
let prepared = false

self.addEventListener('message', ({ data }: MessageEvent<Message>) => {
  if (data.kind === 'open') selecting = new Selecting(data.run, data)
  else void reply(data.number, data.question)
})

async function reply(number: number, question: Question): Promise<void> {
  const send = (message: Reply, transfer: Transferable[] = []) => self.postMessage(message, { transfer })
  try {
    if (!selecting) return
    const answer = await selecting.answer(question)
    const buffers = [answer.lit, answer.chart?.all, answer.chart?.lit].flatMap((array) => (array ? [array.buffer] : []))
    send({ number, answer }, buffers)
    if (prepared) return
    prepared = true
    // What goes wrong here goes wrong again, and is told, when it is asked for.
    await selecting.prepare(question).catch(() => {})
  } catch (error) {
    send({ number, error: error instanceof Error ? error.message : String(error) })
  }
}
