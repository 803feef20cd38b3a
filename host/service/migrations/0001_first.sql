-- One text for SQLite and PostgreSQL: ids and JSON are TEXT, times BIGINT microseconds since the epoch, flags BIGINT
-- 0 or 1. BOOLEAN, TIMESTAMP, UUID, JSONB and NUMERIC do not decode through sqlx::Any on both.

-- Content-addressed files. The row is written before the blob is referred to; a blob without a row is an orphan.
CREATE TABLE blobs (
    sha256 TEXT PRIMARY KEY,
    bytes BIGINT NOT NULL,
    media_type TEXT NOT NULL,
    created_us BIGINT NOT NULL
);

-- Objects that somebody added. Stock objects are made on demand and have no row.
CREATE TABLE objects (
    id TEXT PRIMARY KEY,
    owner TEXT,
    blob TEXT NOT NULL REFERENCES blobs (sha256),
    mesh_sha256 TEXT NOT NULL,
    info TEXT NOT NULL,
    created_us BIGINT NOT NULL
);
CREATE INDEX objects_owner ON objects (owner, created_us);

-- Plugins as the jailed runner described them, by the hash of the file: a known file is not loaded again to be listed.
CREATE TABLE plugins (
    sha256 TEXT PRIMARY KEY,
    algorithms TEXT NOT NULL,
    created_us BIGINT NOT NULL
);

-- Configuration sets by what determines them ("use saved positions").
CREATE TABLE sets (
    id TEXT PRIMARY KEY,
    blob TEXT NOT NULL REFERENCES blobs (sha256),
    info TEXT NOT NULL,
    configurations BIGINT NOT NULL,
    triangles BIGINT NOT NULL,
    seconds DOUBLE PRECISION NOT NULL,
    created_us BIGINT NOT NULL
);

-- The queue and its history: the single source of truth about runs.
CREATE TABLE runs (
    id TEXT PRIMARY KEY,
    owner TEXT,
    featured BIGINT NOT NULL,
    priority BIGINT NOT NULL,
    state TEXT NOT NULL,
    attempts BIGINT NOT NULL,
    message TEXT,
    spec TEXT NOT NULL,
    object_a_name TEXT NOT NULL,
    object_b_name TEXT NOT NULL,
    set_info TEXT,
    set_blob TEXT REFERENCES blobs (sha256),
    environment TEXT,
    expected_seconds DOUBLE PRECISION NOT NULL,
    created_us BIGINT NOT NULL,
    started_us BIGINT,
    finished_us BIGINT
);
CREATE INDEX runs_state ON runs (state, priority, created_us);
CREATE INDEX runs_owner ON runs (owner, created_us);

-- When an owner's run was last started: the fair order of the queue.
CREATE TABLE served (
    owner TEXT PRIMARY KEY,
    served_us BIGINT NOT NULL
);

CREATE TABLE run_stages (
    run_id TEXT NOT NULL REFERENCES runs (id),
    position BIGINT NOT NULL,
    stage TEXT NOT NULL,
    PRIMARY KEY (run_id, position)
);

CREATE TABLE run_events (
    run_id TEXT NOT NULL REFERENCES runs (id),
    seq BIGINT NOT NULL,
    event TEXT NOT NULL,
    PRIMARY KEY (run_id, seq)
);

CREATE TABLE results (
    run_id TEXT NOT NULL REFERENCES runs (id),
    algorithm TEXT NOT NULL,
    position BIGINT NOT NULL,
    plugin_sha256 TEXT NOT NULL,
    result TEXT NOT NULL,
    records TEXT REFERENCES blobs (sha256),
    seconds_per_query DOUBLE PRECISION,
    triangles BIGINT NOT NULL,
    query TEXT NOT NULL,
    created_us BIGINT NOT NULL,
    PRIMARY KEY (run_id, algorithm)
);
CREATE INDEX results_algorithm ON results (algorithm, query, created_us);
