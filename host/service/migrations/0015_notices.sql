-- What accounts are told. The link is a path within the service.
CREATE TABLE notices (
    id TEXT PRIMARY KEY,
    account TEXT NOT NULL REFERENCES accounts (id) ON DELETE CASCADE,
    subject TEXT NOT NULL,
    text TEXT NOT NULL,
    link TEXT NOT NULL,
    created_us BIGINT NOT NULL,
    read_us BIGINT
);
CREATE INDEX notices_account ON notices (account, created_us, id);

-- What accounts have chosen, all of it off at first; and where mails go, which counts once its link was opened.
ALTER TABLE accounts ADD COLUMN agrees_to_reruns BIGINT NOT NULL DEFAULT 0;
ALTER TABLE accounts ADD COLUMN mail_notices BIGINT NOT NULL DEFAULT 0;
ALTER TABLE accounts ADD COLUMN address TEXT;
ALTER TABLE accounts ADD COLUMN confirmed_us BIGINT;

-- Links that confirm an address: only the SHA-256 of the secret in them.
CREATE TABLE confirmations (
    sha256 TEXT PRIMARY KEY,
    account TEXT NOT NULL REFERENCES accounts (id) ON DELETE CASCADE,
    address TEXT NOT NULL,
    expires_us BIGINT NOT NULL
);
CREATE INDEX confirmations_account ON confirmations (account);

-- Mails that wait to be taken by the mail server. One without a notice asks whether the address is right.
CREATE TABLE mails (
    id TEXT PRIMARY KEY,
    account TEXT NOT NULL REFERENCES accounts (id) ON DELETE CASCADE,
    address TEXT NOT NULL,
    notice TEXT REFERENCES notices (id) ON DELETE CASCADE,
    created_us BIGINT NOT NULL,
    due_us BIGINT NOT NULL,
    tries BIGINT NOT NULL
);
CREATE INDEX mails_due ON mails (due_us);
CREATE INDEX mails_account ON mails (account);
CREATE INDEX mails_notice ON mails (notice);
