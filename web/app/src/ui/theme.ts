import { ref, watch } from 'vue'

export type Theme = 'system' | 'light' | 'dark'

const KEY = 'ocb-theme'
const stored = read()

/** The reader's choice; `system` follows the machine. */
export const theme = ref<Theme>(stored)

/** Grows by one each time the colours in force may have changed, for what draws colours itself. */
export const themeChanges = ref(0)

apply(stored)
watch(theme, (choice) => {
  apply(choice)
  try {
    localStorage.setItem(KEY, choice)
  } catch {
    // Storage may be switched off; the choice then lasts until the page is left.
  }
})
window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => themeChanges.value++)

function apply(choice: Theme): void {
  if (choice === 'system') delete document.documentElement.dataset.theme
  else document.documentElement.dataset.theme = choice
  themeChanges.value++
}

function read(): Theme {
  try {
    const choice = localStorage.getItem(KEY)
    return choice === 'light' || choice === 'dark' ? choice : 'system'
  } catch {
    return 'system'
  }
}
