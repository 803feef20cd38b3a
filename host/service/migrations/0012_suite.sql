-- Suites that were measured here, by the hash of their file; and which run belongs to one.
CREATE TABLE suites (
    sha256 TEXT PRIMARY KEY,
    version BIGINT NOT NULL UNIQUE,
    document TEXT NOT NULL,
    created_us BIGINT NOT NULL
);
ALTER TABLE runs ADD COLUMN suite TEXT REFERENCES suites (sha256);
CREATE INDEX runs_suite ON runs (suite, state);
