-- Stability runs of the service itself come after those of visitors.
ALTER TABLE stability_runs ADD COLUMN priority BIGINT NOT NULL DEFAULT 1;
-- What the parts that are done took: guests have a time limit.
ALTER TABLE stability_runs ADD COLUMN spent_seconds DOUBLE PRECISION NOT NULL DEFAULT 0;
-- What was tried while idle, whatever came out, so that it is tried once.
CREATE TABLE idle_tried (
    what TEXT NOT NULL,
    algorithm TEXT NOT NULL,
    plugin_sha256 TEXT NOT NULL,
    run TEXT NOT NULL,
    PRIMARY KEY (what, algorithm, plugin_sha256)
);
CREATE INDEX idle_tried_by_run ON idle_tried (run);
