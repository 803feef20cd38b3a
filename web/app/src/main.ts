import { VueQueryPlugin } from '@tanstack/vue-query'
import { createApp } from 'vue'
import { ApiError } from './api/errors'
import App from './App.vue'
import { router } from './router'
import './style/tokens.css'
import './style/base.css'
import './style/parts.css'
import './ui/theme'

createApp(App)
  .use(router)
  .use(VueQueryPlugin, {
    queryClientConfig: {
      defaultOptions: {
        queries: {
          refetchOnWindowFocus: false,
          // Only what may pass by itself is worth asking again.
          retry: (failures, error) => failures < 2 && error instanceof ApiError && error.passing,
        },
      },
    },
  })
  .mount('#app')
