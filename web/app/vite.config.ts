import vue from '@vitejs/plugin-vue'
import { defineConfig } from 'vitest/config'

export default defineConfig({
  plugins: [vue()],
  build: {
    target: 'es2022',
    // three alone is over the default 500 kB; it loads only with a page that draws.
    chunkSizeWarningLimit: 900,
  },
  server: {
    // `npm run dev` beside a running `ocb serve`; OCB_API names another address.
    // The service compares where a request comes from with where it goes to, so the host must stay as it is.
    proxy: { '/api': { target: process.env.OCB_API ?? 'http://127.0.0.1:8080', changeOrigin: false } },
  },
  // One environment for many files: a new one for each took 50 of 58 seconds.
  test: { environment: 'happy-dom', isolate: false, include: ['src/**/*.test.ts'] },
})
