//! The parts of a service, put together: each gets those that it needs.

use std::sync::Arc;

use crate::advice::work::{Advices, Sources};
use crate::attempts::beat::Leases;
use crate::blobs::Blobs;
use crate::campaigns::course::Campaigns;
use crate::charts::Charts;
use crate::classes::Classes;
use crate::engine::Inner;
use crate::idle::IdleWork;
use crate::machine::{Machine, lock_data_folder};
use crate::machines::under_way::Orders;
use crate::mail::outbox::Outbox;
use crate::objects::Objects;
use crate::owned::items::Owned;
use crate::plugins::checks::Checks;
use crate::plugins::registry::Registry;
use crate::results::Results;
use crate::runs::asking::Runs;
use crate::runs::benchmarks::Benchmarks;
use crate::runs::current::Work;
use crate::runs::dispatcher::Dispatcher;
use crate::runs::ends::RunEnds;
use crate::runs::events::RunEvents;
#[cfg(feature = "postgres")]
use crate::runs::hear::Notifications;
use crate::runs::live::LiveRuns;
use crate::runs::preliminary::UnderWay;
use crate::sets::stored::Sets;
use crate::stability::work::StabilityRuns;
use crate::store::Store;
use crate::suite::Suite;
use crate::suite::known::SuiteRuns;
use crate::tasks::Tasks;
use crate::workloads::recordings::Recordings;
use crate::workloads::replay::Replays;
use crate::{EngineConfig, Result};

impl Inner {
    /// Makes the parts of an engine on its data folder; none works yet.
    pub async fn of(config: EngineConfig) -> Result<Self> {
        let lock = lock_data_folder(&config.data)?;
        let store = Store::open(&config.data, config.database_url.as_deref()).await?;
        let blobs = Blobs::open(&config.data, config.blob_url.as_deref())?;
        let registry = Arc::new(Registry::open(&config, &store, &blobs).await?);
        let suite = Arc::new(Suite::open(config.suite.as_deref())?);
        let machine = Machine::observe()?.noted(config.machine_note.as_deref());
        let work = Arc::new(Work::new(lock, &machine.hardware_class)?);
        let tasks: Arc<Tasks> = Arc::default();
        let objects = Arc::new(Objects::new(store.clone(), blobs.clone(), config.stock_dir.clone()));
        let sets = Arc::new(Sets::new(store.clone(), blobs.clone()));
        let under_way: Arc<UnderWay> = Arc::default();
        let results = Results::new(store.clone(), blobs.clone(), objects.clone(), sets.clone(), under_way.clone());
        let results = Arc::new(results);
        let classes = Arc::new(Classes::of(&machine.hardware_class, &machine.cpu, config.elsewhere));
        let outbox = Arc::new(Outbox::new(store.clone(), config.mail.clone()));
        let recordings = Arc::new(Recordings::new(blobs.clone(), config.data.clone()));
        let run_events = RunEvents::new();
        let live = Arc::new(LiveRuns {
            store: store.clone(),
            registry: registry.clone(),
            run_events: run_events.clone(),
            under_way: under_way.clone(),
        });
        let suite_runs = Arc::new(SuiteRuns {
            store: store.clone(),
            suite: suite.clone(),
            classes: classes.clone(),
            profile: registry.profile(),
        });
        let campaigns = Arc::new(Campaigns {
            store: store.clone(),
            objects: objects.clone(),
            registry: registry.clone(),
            suite_runs: suite_runs.clone(),
            outbox: outbox.clone(),
            run_events: run_events.clone(),
        });
        let sources = Sources {
            store: store.clone(),
            blobs: blobs.clone(),
            objects: objects.clone(),
            machine: machine.clone(),
            program: config.advisor.clone(),
            data: config.data.clone(),
            quick: config.quick_advice,
            elsewhere: config.elsewhere,
        };
        Ok(Self {
            runs: Arc::new(Runs {
                store: store.clone(),
                blobs: blobs.clone(),
                objects: objects.clone(),
                registry: registry.clone(),
                classes: classes.clone(),
                run_events: run_events.clone(),
                work: work.clone(),
                ceilings: config.ceilings,
            }),
            run_ends: Arc::new(RunEnds {
                store: store.clone(),
                run_events: run_events.clone(),
                campaigns: campaigns.clone(),
                work: work.clone(),
            }),
            replays: Arc::new(Replays {
                store: store.clone(),
                blobs: blobs.clone(),
                registry: registry.clone(),
                recordings: recordings.clone(),
                work: work.clone(),
                machine: machine.clone(),
                ceilings: config.ceilings,
                advisor: config.advisor.clone(),
                data: config.data.clone(),
                elsewhere: config.elsewhere,
            }),
            checks: Arc::new(Checks {
                store: store.clone(),
                blobs: blobs.clone(),
                registry: registry.clone(),
                outbox: outbox.clone(),
                work: work.clone(),
                data: config.data.clone(),
                quick: config.quick_checks,
                limit: config.check_limit,
                elsewhere: config.elsewhere,
            }),
            stability: Arc::new(StabilityRuns {
                store: store.clone(),
                registry: registry.clone(),
                work: work.clone(),
                machine: machine.clone(),
                ceilings: config.ceilings,
                elsewhere: config.elsewhere,
            }),
            owned: Owned {
                store: store.clone(),
                blobs: blobs.clone(),
                objects: objects.clone(),
                guest_days: config.guest_days,
            },
            advices: Arc::new(Advices::new(sources, work.clone())),
            orders: Arc::new(Orders::new(live.clone(), objects.clone(), suite.clone(), config.ceilings)),
            charts: Charts::new(store.clone(), objects.clone(), results.clone(), machine.clone(), registry.profile()),
            house: Arc::default(),
            config,
            store,
            blobs,
            objects,
            registry,
            machine,
            classes,
            run_events,
            live,
            under_way,
            suite,
            suite_runs,
            campaigns,
            work,
            tasks,
            sets,
            results,
            recordings,
            outbox,
        })
    }

    /// What works on the queue.
    pub fn dispatcher(&self) -> Dispatcher {
        let benchmarks = Arc::new(Benchmarks {
            store: self.store.clone(),
            blobs: self.blobs.clone(),
            objects: self.objects.clone(),
            registry: self.registry.clone(),
            sets: self.sets.clone(),
            results: self.results.clone(),
            suite: self.suite.clone(),
            live: self.live.clone(),
            run_ends: self.run_ends.clone(),
            work: self.work.clone(),
            machine: self.machine.clone(),
            ceilings: self.config.ceilings,
            elsewhere: self.config.elsewhere,
        });
        let idle = IdleWork {
            store: self.store.clone(),
            registry: self.registry.clone(),
            classes: self.classes.clone(),
            house: self.house.clone(),
            work: self.work.clone(),
            suite_runs: self.suite_runs.clone(),
            runs: self.runs.clone(),
            benchmarks: benchmarks.clone(),
            stability: self.stability.clone(),
            advices: self.advices.clone(),
            wanted: self.config.idle,
            next: None,
        };
        Dispatcher {
            work: self.work.clone(),
            checks: self.checks.clone(),
            stability: self.stability.clone(),
            replays: self.replays.clone(),
            benchmarks,
            idle,
        }
    }

    /// What keeps the attempts of this process.
    pub fn leases(&self) -> Leases {
        Leases {
            store: self.store.clone(),
            work: self.work.clone(),
            classes: self.classes.clone(),
            house: self.house.clone(),
            run_ends: self.run_ends.clone(),
            outbox: self.outbox.clone(),
        }
    }

    /// What hears of other services on the same database.
    #[cfg(feature = "postgres")]
    pub fn notifications(&self) -> Notifications {
        Notifications {
            work: self.work.clone(),
            outbox: self.outbox.clone(),
            live: self.live.clone(),
            orders: self.orders.clone(),
        }
    }
}
