-- A run whose configurations are stored, so that a measuring machine can take it.
ALTER TABLE runs ADD COLUMN prepared BIGINT NOT NULL DEFAULT 0;
CREATE INDEX runs_prepared ON runs (turn) WHERE prepared = 1 AND state = 'queued';

-- What a measuring machine was told to do: its results are compared with that.
ALTER TABLE attempts ADD COLUMN work TEXT;

-- Machines that measure for this service. The token is known by its hash alone. The facts are what a machine said of itself last;
-- trouble says why it gets no run, and until when.
CREATE TABLE machines (
    name TEXT PRIMARY KEY,
    token_sha256 TEXT NOT NULL UNIQUE,
    facts TEXT,
    created_us BIGINT NOT NULL,
    seen_us BIGINT,
    revoked_us BIGINT,
    trouble TEXT,
    rests_until_us BIGINT NOT NULL DEFAULT 0
);
