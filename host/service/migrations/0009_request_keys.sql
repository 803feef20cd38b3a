-- What a program calls its request for a run, so that asking again after a lost answer does not make another.
ALTER TABLE runs ADD COLUMN request_key TEXT;
CREATE UNIQUE INDEX runs_request ON runs (owner, request_key);
