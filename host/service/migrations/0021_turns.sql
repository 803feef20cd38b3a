-- Whose turn a run takes: its owner's; nobody's for runs of the service and of campaigns.
ALTER TABLE runs ADD COLUMN turn TEXT NOT NULL DEFAULT '';
UPDATE runs SET turn = COALESCE(owner, '') WHERE campaign IS NULL;
CREATE INDEX runs_turns ON runs (state, priority, turn, created_us, id);
