-- The number of a run's newest event. Writers queue at the run's row, so that two of them never choose one number.
ALTER TABLE runs ADD COLUMN last_event BIGINT NOT NULL DEFAULT 0;
UPDATE runs SET last_event = COALESCE((SELECT MAX(seq) FROM run_events WHERE run_id = runs.id), 0);
