-- Advice about levels of detail: what was asked and became of it as JSON, and the blobs of the reduced objects.
CREATE TABLE advice (
    id TEXT PRIMARY KEY,
    owner TEXT,
    ended BIGINT NOT NULL,
    attempts BIGINT NOT NULL,
    info TEXT NOT NULL,
    papers TEXT NOT NULL,
    created_us BIGINT NOT NULL
);
