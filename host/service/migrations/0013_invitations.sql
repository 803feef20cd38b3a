-- Invitations to be a developer: only the SHA-256 of the secret in the link. Rows stay when they have ended.
CREATE TABLE invitations (
    id TEXT PRIMARY KEY,
    sha256 TEXT NOT NULL UNIQUE,
    -- Absent when whoever has the data folder made it.
    invited_by TEXT REFERENCES accounts (id),
    recipient TEXT NOT NULL,
    created_us BIGINT NOT NULL,
    expires_us BIGINT NOT NULL,
    revoked_us BIGINT,
    accepted_us BIGINT,
    accepted_by TEXT REFERENCES accounts (id)
);
CREATE INDEX invitations_created ON invitations (created_us, id);
