-- Accounts. Their things belong to the owner 'account:<id>', a text that no guest's cookie can be.
CREATE TABLE accounts (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    -- The name in lower case: names that differ by that alone are one.
    folded TEXT NOT NULL UNIQUE,
    password TEXT NOT NULL,
    role TEXT NOT NULL,
    wish TEXT,
    created_us BIGINT NOT NULL
);

-- Sessions of browsers and tokens of programs: only the SHA-256 of what the holder shows. A session has no name.
CREATE TABLE keys (
    sha256 TEXT PRIMARY KEY,
    id TEXT NOT NULL,
    account TEXT NOT NULL REFERENCES accounts (id),
    name TEXT,
    scopes TEXT NOT NULL,
    created_us BIGINT NOT NULL,
    expires_us BIGINT NOT NULL
);
CREATE INDEX keys_account ON keys (account, created_us);

-- Who did what to what. Rows are only ever added; each holds the hash of the one before it, so that a row that was taken
-- out or changed by hand is noticed.
CREATE TABLE audit (
    seq BIGINT PRIMARY KEY,
    at_us BIGINT NOT NULL,
    actor TEXT NOT NULL,
    action TEXT NOT NULL,
    subject TEXT NOT NULL,
    detail TEXT NOT NULL,
    chain TEXT NOT NULL
);
CREATE INDEX audit_subject ON audit (subject, seq);
