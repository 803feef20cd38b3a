-- The minisign key that an account has registered, and the one that a plugin was signed with when it was sent.
ALTER TABLE accounts ADD COLUMN signing_key TEXT;
ALTER TABLE submissions ADD COLUMN signed_by TEXT;
