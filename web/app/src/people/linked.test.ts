import { expect, it } from 'vitest'
import { linked } from './linked'

it('links the runs and campaigns of this service and nothing else', () => {
  const run = '/r/0193f1a0-0000-7000-8000-000000000000'
  const campaign = '/campaigns/0193f1a0-0000-7000-8000-000000000001'
  expect(linked(`It failed in ${campaign} (x; run ${run}). Really.`)).toEqual([
    { text: 'It failed in ' }, { text: campaign, to: campaign }, { text: ' (x; run ' }, { text: run, to: run }, { text: '). Really.' },
  ])
  for (const plain of ['It is slow.', '/r/nonsense', `https://evil.example${run}`, `${run}/x`, 'javascript:alert(1)']) {
    expect(linked(plain)).toEqual([{ text: plain }])
  }
})
