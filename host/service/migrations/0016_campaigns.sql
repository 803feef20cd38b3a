-- Campaigns: stored benchmarks that are measured again, because the hardware class, the suite or the oracle is another one.
CREATE TABLE campaigns (
    id TEXT PRIMARY KEY,
    reason TEXT NOT NULL,
    -- What is measured again: the suite, runs of people.
    of_suite BIGINT NOT NULL,
    of_people BIGINT NOT NULL,
    created_by TEXT NOT NULL,
    created_us BIGINT NOT NULL,
    -- What the results are of.
    hardware_class TEXT NOT NULL,
    oracle BIGINT NOT NULL,
    suite TEXT NOT NULL REFERENCES suites (sha256),
    -- Since when all of it is in the queue; absent where the service ended before.
    queued_us BIGINT,
    cancelled_us BIGINT,
    -- Since when nothing of it waits any more and everybody is told.
    ended_us BIGINT
);
CREATE INDEX campaigns_created ON campaigns (created_us, id);

-- A run of a campaign; and which it repeats, whose owner may have taken it away since. A campaign repeats a run once.
ALTER TABLE runs ADD COLUMN campaign TEXT REFERENCES campaigns (id);
ALTER TABLE runs ADD COLUMN rerun_of TEXT;
CREATE UNIQUE INDEX runs_rerun ON runs (campaign, rerun_of);
CREATE INDEX runs_rerun_of ON runs (rerun_of);

-- The hardware class on which a plugin was taken out, where that is not the one of its check.
ALTER TABLE submissions ADD COLUMN excluded_on TEXT;
