-- What the run's seed is drawn from. Its hash is shown while the run waits, itself only with the result.
ALTER TABLE runs ADD COLUMN secret TEXT;
