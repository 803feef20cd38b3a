import { nextTick } from 'vue'
import { createRouter, createWebHistory } from 'vue-router'
import StartPage from './pages/StartPage.vue'

export const router = createRouter({
  history: createWebHistory(),
  routes: [
    { path: '/', component: StartPage, meta: { title: 'Where is it slow?' } },
    { path: '/new', component: () => import('./pages/BuilderPage.vue'), meta: { title: 'New benchmark' } },
    { path: '/r/:id', component: () => import('./pages/RunPage.vue'), props: true, meta: { title: 'Run' } },
    { path: '/board', component: () => import('./pages/BoardPage.vue'), meta: { title: 'Leaderboard' } },
    { path: '/runs', component: () => import('./pages/RunsPage.vue'), meta: { title: 'My runs' } },
    { path: '/objects', component: () => import('./pages/ObjectsPage.vue'), meta: { title: 'Objects' } },
    { path: '/account', component: () => import('./pages/AccountPage.vue'), meta: { title: 'Account' } },
    { path: '/mails/off/:secret', component: () => import('./pages/MailsOffPage.vue'), props: true, meta: { title: 'Turn mails off' } },
    { path: '/submit', component: () => import('./pages/SubmitPage.vue'), meta: { title: 'Submit a plugin' } },
    { path: '/plugins', component: () => import('./pages/PluginsPage.vue'), meta: { title: 'Plugins' } },
    { path: '/p/:id', component: () => import('./pages/PluginPage.vue'), props: true, meta: { title: 'Plugin' } },
    { path: '/curate', component: () => import('./pages/CuratePage.vue'), meta: { title: 'Curate' } },
    { path: '/campaigns', component: () => import('./pages/CampaignsPage.vue'), meta: { title: 'Repeated benchmarks' } },
    { path: '/campaigns/:id', component: () => import('./pages/CampaignPage.vue'), props: true, meta: { title: 'Repeated benchmarks' } },
    { path: '/stability', component: () => import('./pages/StabilityPage.vue'), meta: { title: 'Where algorithms fail' } },
    { path: '/stability/:id', component: () => import('./pages/StabilityRunPage.vue'), props: true, meta: { title: 'Stability run' } },
    { path: '/workloads', component: () => import('./pages/WorkloadsPage.vue'), meta: { title: 'Workloads' } },
    { path: '/workloads/:id', component: () => import('./pages/WorkloadPage.vue'), props: true, meta: { title: 'Replayed recording' } },
    { path: '/advisor/:id?', component: () => import('./pages/AdvisorPage.vue'), props: true, meta: { title: 'How much detail is enough?' } },
    { path: '/about', component: () => import('./pages/AboutPage.vue'), meta: { title: 'How we measure' } },
    { path: '/truth', component: () => import('./pages/TruthPage.vue'), meta: { title: 'How answers are judged' } },
    { path: '/status', component: () => import('./pages/StatusPage.vue'), meta: { title: 'Status' } },
    { path: '/api', component: () => import('./pages/ApiPage.vue'), meta: { title: 'API' } },
    { path: '/:rest(.*)*', component: () => import('./pages/NotFoundPage.vue'), meta: { title: 'Page not found' } },
  ],
  scrollBehavior: (to, from, saved) => saved ?? (to.hash ? { el: to.hash, top: 90 } : to.path === from.path ? false : { top: 0 }),
})

router.afterEach(async (to, from) => {
  document.title = `${String(to.meta.title ?? 'Benchmark')} · OpenCollBench`
  if (to.path === from.path || from.matched.length === 0) return
  // A screen reader starts at the new page's heading, as after a real page load.
  await nextTick()
  document.querySelector<HTMLElement>('main')?.focus({ preventScroll: true })
})
