-- Recordings that visitors bring, with their replay: what was asked, how far it is, and what was found, as JSON. The recording and
-- the table of its queries are blobs.
CREATE TABLE workloads (
    id TEXT PRIMARY KEY,
    owner TEXT,
    turn TEXT NOT NULL,
    state TEXT NOT NULL,
    attempts BIGINT NOT NULL,
    message TEXT,
    spec TEXT NOT NULL,
    recording TEXT NOT NULL,
    blob TEXT NOT NULL,
    queries TEXT,
    result TEXT,
    done BIGINT NOT NULL,
    created_us BIGINT NOT NULL,
    finished_us BIGINT
);
CREATE INDEX workloads_by_owner ON workloads (owner, created_us);
