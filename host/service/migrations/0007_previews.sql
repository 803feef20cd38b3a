-- What the results of a run are a preview of (JSON); nothing when all configurations were measured.
ALTER TABLE runs ADD COLUMN preview TEXT;
