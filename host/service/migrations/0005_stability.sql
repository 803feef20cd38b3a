-- Where methods fail: the newest result of each algorithm, as JSON.
CREATE TABLE stability (
    algorithm TEXT PRIMARY KEY,
    result TEXT NOT NULL,
    created_us BIGINT NOT NULL
);
