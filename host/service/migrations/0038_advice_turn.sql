-- Whose request it is: an account, or the guests of an address. Open requests are counted by it.
ALTER TABLE advice ADD COLUMN turn TEXT NOT NULL DEFAULT '';
UPDATE advice SET turn = COALESCE(owner, '');
CREATE INDEX advice_open ON advice (turn) WHERE ended = 0;
