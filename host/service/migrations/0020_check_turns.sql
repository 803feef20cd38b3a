-- When the latest check of a plugin was begun: authors take turns.
ALTER TABLE submissions ADD COLUMN begun_us BIGINT NOT NULL DEFAULT 0;
CREATE INDEX submissions_turns ON submissions (account, begun_us);
