//! Opening a service on its data folder, and closing it.

use std::sync::Arc;

use crate::advice::work::{Advices, Sources};
use crate::attempts::beat::Leases;
use crate::blobs::Blobs;
use crate::boxed;
use crate::campaigns::course::Campaigns;
use crate::charts::Charts;
use crate::classes::Classes;
use crate::engine::{Engine, Inner};
use crate::house::House;
use crate::idle::IdleWork;
use crate::machine::{Machine, lock_data_folder};
use crate::machines::under_way::Orders;
use crate::mail::outbox::Outbox;
use crate::model::Status;
use crate::objects::Objects;
use crate::owned::items::Owned;
use crate::plugins::checks::Checks;
use crate::plugins::registry::Registry;
use crate::results::Results;
use crate::runs::asking::Runs;
use crate::runs::carry_out::Benchmarks;
use crate::runs::current::Work;
use crate::runs::dispatcher::Dispatcher;
use crate::runs::ends::RunEnds;
use crate::runs::live::LiveRuns;
use crate::runs::log::RunEvents;
use crate::runs::preliminary::UnderWay;
use crate::runs::priority::BACKGROUND;
use crate::sets::stored::Sets;
use crate::stability::work::StabilityRuns;
use crate::store::{Store, now_us};
use crate::suite::Suite;
use crate::suite::known::SuiteRuns;
use crate::tasks::Tasks;
use crate::workloads::recordings::Recordings;
use crate::workloads::replay::Replays;
use crate::{EngineConfig, EngineError, Result};

impl Engine {
    /// Opens the data folder, migrates the database, puts the work of its dead predecessor back into the queue and begins to work on it.
    ///
    /// # Errors
    /// [`EngineError::Busy`] when another process has this folder open; `Fault` when folder, database, blob storage or
    /// runner cannot be used.
    #[boxed]
    pub async fn open(config: EngineConfig) -> Result<Self> {
        std::fs::create_dir_all(&config.data).map_err(|e| {
            EngineError::Fault(format!("The data folder {} cannot be created: {e}.", config.data.display()))
        })?;
        let lock = lock_data_folder(&config.data)?;
        let store = Store::open(&config.data, config.database_url.as_deref()).await?;
        let blobs = Blobs::open(&config.data, config.blob_url.as_deref())?;
        let registry = Arc::new(Registry::open(&config, &store, &blobs).await?);
        let suite = Arc::new(Suite::open(config.suite.as_deref())?);
        let machine = Machine::observe()?.noted(config.machine_note.as_deref());
        let objects = Arc::new(Objects::new(store.clone(), blobs.clone(), config.stock_dir.clone()));
        let sets = Arc::new(Sets::new(store.clone(), blobs.clone()));
        let under_way: Arc<UnderWay> = Arc::default();
        let results = Results::new(store.clone(), blobs.clone(), objects.clone(), sets.clone(), under_way.clone());
        let results = Arc::new(results);
        let classes = Arc::new(Classes::of(&machine.hardware_class, &machine.cpu, config.elsewhere));
        let suite_runs = Arc::new(SuiteRuns {
            store: store.clone(),
            suite: suite.clone(),
            classes: classes.clone(),
            profile: registry.profile(),
        });
        let outbox = Arc::new(Outbox::new(store.clone(), config.mail.clone()));
        let run_events = RunEvents::new();
        let work = Arc::new(Work::new(lock, &machine.hardware_class)?);
        let checks = Arc::new(Checks {
            store: store.clone(),
            blobs: blobs.clone(),
            registry: registry.clone(),
            outbox: outbox.clone(),
            work: work.clone(),
            data: config.data.clone(),
            quick: config.quick_checks,
            limit: config.check_limit,
        });
        let stability = Arc::new(StabilityRuns {
            store: store.clone(),
            registry: registry.clone(),
            work: work.clone(),
            machine: machine.clone(),
            ceilings: config.ceilings,
        });
        let campaigns = Arc::new(Campaigns {
            store: store.clone(),
            objects: objects.clone(),
            registry: registry.clone(),
            suite_runs: suite_runs.clone(),
            outbox: outbox.clone(),
            run_events: run_events.clone(),
        });
        let run_ends = Arc::new(RunEnds {
            store: store.clone(),
            run_events: run_events.clone(),
            campaigns: campaigns.clone(),
            work: work.clone(),
        });
        let live = Arc::new(LiveRuns {
            store: store.clone(),
            registry: registry.clone(),
            run_events: run_events.clone(),
            under_way: under_way.clone(),
        });
        let orders = Arc::new(Orders::new(live.clone(), objects.clone(), suite.clone(), config.ceilings));
        let benchmarks = Arc::new(Benchmarks {
            store: store.clone(),
            blobs: blobs.clone(),
            objects: objects.clone(),
            registry: registry.clone(),
            sets: sets.clone(),
            results: results.clone(),
            suite: suite.clone(),
            live: live.clone(),
            run_ends: run_ends.clone(),
            work: work.clone(),
            machine: machine.clone(),
            ceilings: config.ceilings,
            elsewhere: config.elsewhere,
        });
        let runs = Arc::new(Runs {
            store: store.clone(),
            blobs: blobs.clone(),
            objects: objects.clone(),
            registry: registry.clone(),
            classes: classes.clone(),
            run_events: run_events.clone(),
            work: work.clone(),
            ceilings: config.ceilings,
        });
        let house: Arc<House> = Arc::default();
        let recordings = Arc::new(Recordings::new(blobs.clone(), config.data.clone()));
        let replays = Arc::new(Replays {
            store: store.clone(),
            blobs: blobs.clone(),
            registry: registry.clone(),
            recordings: recordings.clone(),
            work: work.clone(),
            machine: machine.clone(),
            ceilings: config.ceilings,
            advisor: config.advisor.clone(),
            data: config.data.clone(),
        });
        let tasks: Arc<Tasks> = Arc::default();
        let sources = Sources {
            store: store.clone(),
            blobs: blobs.clone(),
            objects: objects.clone(),
            machine: machine.clone(),
            program: config.advisor.clone(),
            data: config.data.clone(),
            quick: config.quick_advice,
        };
        let advices = Arc::new(Advices::new(sources, work.clone(), tasks.clone()));
        let leases = Leases {
            store: store.clone(),
            work: work.clone(),
            classes: classes.clone(),
            house: house.clone(),
            run_ends: run_ends.clone(),
            advices: advices.clone(),
            outbox: outbox.clone(),
        };
        let idle = IdleWork {
            store: store.clone(),
            registry: registry.clone(),
            classes: classes.clone(),
            house: house.clone(),
            work: work.clone(),
            suite_runs: suite_runs.clone(),
            runs: runs.clone(),
            benchmarks: benchmarks.clone(),
            stability: stability.clone(),
            advices: advices.clone(),
            wanted: config.idle,
            next: None,
        };
        let dispatcher =
            Dispatcher { work: work.clone(), checks, stability, replays: replays.clone(), benchmarks, idle };
        let inner = Arc::new(Inner {
            work,
            recordings,
            replays,
            advices,
            campaigns,
            run_ends,
            live,
            orders,
            runs,
            tasks,
            charts: Charts::new(store.clone(), objects.clone(), results.clone(), machine.clone(), registry.profile()),
            suite_runs,
            outbox,
            run_events,
            classes,
            suite,
            house,
            owned: Owned {
                store: store.clone(),
                blobs: blobs.clone(),
                objects: objects.clone(),
                guest_days: config.guest_days,
            },
            config,
            machine,
            objects,
            sets,
            results,
            under_way,
            store,
            blobs,
            registry,
        });
        let engine = Self { inner };
        engine.inner.registry.renew().await?;
        engine.inner.classes.learn_from(&engine.inner.store).await?;
        if engine.inner.config.dispatch {
            engine.inner.store.believe_machines().await?;
            leases.take_back(Some(&engine.inner.work.worker)).await?;
            engine.open_house().await?;
            engine.inner.tasks.spawn(dispatcher.work());
            engine.inner.tasks.spawn(engine.clone().sweep());
            engine.inner.tasks.spawn(engine.clone().look_after_campaigns());
            let inner = engine.inner.clone();
            engine.inner.tasks.spawn(async move { inner.outbox.post(&inner.house).await });
            if let Some(jobs) = engine.inner.config.slurm.clone() {
                engine.inner.tasks.spawn(engine.clone().supply(jobs));
            }
        }
        engine.inner.tasks.spawn(leases.beat());
        #[cfg(feature = "postgres")]
        if let Some(url) = engine.inner.config.postgres_url() {
            let notifications = crate::runs::hear::Notifications {
                work: engine.inner.work.clone(),
                outbox: engine.inner.outbox.clone(),
                live: engine.inner.live.clone(),
                orders: engine.inner.orders.clone(),
            };
            engine.inner.tasks.listen(notifications.hear(url.to_owned()));
        }
        Ok(engine)
    }

    /// Stops working: a run under way goes back into the queue; when this returns, everything known is on disk and another
    /// engine may open the folder, even while handles of this one exist.
    #[boxed]
    pub async fn shutdown(&self) {
        self.inner.work.close();
        self.inner.advices.stop_all();
        self.inner.house.close();
        self.inner.tasks.ended().await;
        self.inner.house.leave().await;
        self.inner.store.close().await;
        self.inner.work.leave();
    }

    /// The service at a glance.
    #[boxed]
    pub async fn status(&self) -> Result<Status> {
        let store = &self.inner.store;
        let (queued, expected_seconds) = store.waiting_in_all(BACKGROUND).await?;
        let machines = if self.inner.config.elsewhere { store.machines().await? } else { Vec::new() };
        let now = now_us();
        Ok(Status {
            version: env!("CARGO_PKG_VERSION").into(),
            hardware_class: self.inner.classes.usual(),
            classes: self.inner.classes.status(store).await?,
            running: store.running_in_all().await?,
            queued,
            oldest_seconds: store.oldest_seconds().await?,
            expected_seconds,
            idle_work: self.inner.config.idle,
            elsewhere: self.inner.config.elsewhere,
            machines: machines.iter().filter_map(|machine| machine.status(now)).collect(),
            algorithms: self.inner.registry.algorithms(None).len() as u32,
            problems: self.inner.registry.problems(),
        })
    }
}
