-- Configurations that visitors saved, from a file or of a run, to measure on them again.
CREATE TABLE saved_configurations (
    id TEXT PRIMARY KEY,
    owner TEXT NOT NULL,
    blob TEXT NOT NULL,
    name TEXT NOT NULL,
    configurations BIGINT NOT NULL,
    straightened BIGINT NOT NULL,
    created_us BIGINT NOT NULL
);
CREATE INDEX saved_configurations_by_owner ON saved_configurations (owner, created_us);
CREATE INDEX saved_configurations_by_blob ON saved_configurations (blob);
