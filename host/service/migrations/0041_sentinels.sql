-- What the sentinel took on each measuring machine, about once an hour, for a week: nanoseconds of its median query, and whether that
-- was off when it came.
CREATE TABLE sentinels (
    machine TEXT NOT NULL,
    hardware_class TEXT NOT NULL,
    at_us BIGINT NOT NULL,
    median_ns DOUBLE PRECISION NOT NULL,
    off BIGINT NOT NULL
);
CREATE INDEX sentinels_by_class ON sentinels (hardware_class, at_us);
