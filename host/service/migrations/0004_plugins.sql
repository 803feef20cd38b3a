-- Plugins that developers bring. The file is a blob; the same bytes of one account are one row.
CREATE TABLE submissions (
    id TEXT PRIMARY KEY,
    account TEXT NOT NULL REFERENCES accounts (id),
    blob TEXT NOT NULL REFERENCES blobs (sha256),
    file TEXT NOT NULL,
    bytes BIGINT NOT NULL,
    manifest TEXT NOT NULL,
    state TEXT NOT NULL,
    reason TEXT NOT NULL,
    hardware_class TEXT,
    algorithms TEXT NOT NULL,
    attempts BIGINT NOT NULL,
    created_us BIGINT NOT NULL,
    changed_us BIGINT NOT NULL,
    UNIQUE (account, blob)
);
CREATE INDEX submissions_state ON submissions (state, created_us);

-- The report of a plugin, line by line as it is found.
CREATE TABLE submission_lines (
    submission TEXT NOT NULL REFERENCES submissions (id),
    seq BIGINT NOT NULL,
    line TEXT NOT NULL,
    PRIMARY KEY (submission, seq)
);

-- A run with a plugin that was not public when it was asked for: only its owner sees it.
ALTER TABLE runs ADD COLUMN private BIGINT NOT NULL DEFAULT 0;
