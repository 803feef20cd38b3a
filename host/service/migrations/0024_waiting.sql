-- Counts what waits, and adds up its expected time, without reading the runs.
CREATE INDEX runs_waiting ON runs (state, priority, expected_seconds);
