-- From which network a run was asked for, where that is known, and how long it may measure: what one visitor may have waiting and
-- under way is limited by both.
ALTER TABLE runs ADD COLUMN address TEXT;
ALTER TABLE runs ADD COLUMN granted_seconds DOUBLE PRECISION NOT NULL DEFAULT 0;
CREATE INDEX runs_addresses ON runs (address, state);
