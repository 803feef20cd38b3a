-- Who sees an object or a run: private, unlisted (whoever has the link) or public.
ALTER TABLE objects ADD COLUMN visibility TEXT NOT NULL DEFAULT 'unlisted';
ALTER TABLE runs ADD COLUMN visibility TEXT NOT NULL DEFAULT 'unlisted';
UPDATE runs SET visibility = 'public' WHERE featured = 1;
CREATE INDEX objects_visibility ON objects (visibility, created_us);
CREATE INDEX runs_visibility ON runs (visibility, finished_us);
