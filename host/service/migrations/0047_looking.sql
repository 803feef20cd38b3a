-- Counts what waits for a hardware class, and adds up its expected time, without reading the runs; finds the start page's run.
DROP INDEX runs_waiting;
CREATE INDEX runs_waiting ON runs (state, priority, hardware_class, expected_seconds);
CREATE INDEX runs_featured ON runs (state) WHERE featured = 1;
