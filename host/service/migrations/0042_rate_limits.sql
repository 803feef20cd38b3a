-- What visitors do, counted by all services on this database together: when the bucket of a place is empty again. A place is a keyed
-- hash, so that neither addresses nor names stand here.
CREATE TABLE rate_limits (
    kind TEXT NOT NULL,
    place BIGINT NOT NULL,
    empty_us BIGINT NOT NULL,
    PRIMARY KEY (kind, place)
);
-- One row with the key.
CREATE TABLE rate_limit_key (
    one BIGINT PRIMARY KEY,
    key TEXT NOT NULL
);
