-- Links in mails that turn mails off: only the SHA-256 of the secret in them.
CREATE TABLE off_links (
    sha256 TEXT PRIMARY KEY,
    account TEXT NOT NULL REFERENCES accounts (id) ON DELETE CASCADE,
    address TEXT NOT NULL,
    expires_us BIGINT NOT NULL
);
CREATE INDEX off_links_account ON off_links (account);
CREATE INDEX off_links_expires ON off_links (expires_us);
