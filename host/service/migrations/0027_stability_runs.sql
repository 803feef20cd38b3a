-- Stability runs that visitors start: what was asked, which parts are done, and what they found so far, as JSON.
CREATE TABLE stability_runs (
    id TEXT PRIMARY KEY,
    owner TEXT,
    turn TEXT NOT NULL,
    state TEXT NOT NULL,
    attempts BIGINT NOT NULL,
    message TEXT,
    name TEXT NOT NULL,
    spec TEXT NOT NULL,
    done TEXT NOT NULL,
    found TEXT,
    created_us BIGINT NOT NULL,
    finished_us BIGINT
);
CREATE INDEX stability_runs_by_owner ON stability_runs (owner, created_us);
