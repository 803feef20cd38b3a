-- What programs call their requests: asked again under the same key, the same request makes nothing new. The id of what it makes
-- is chosen when it comes first; the digest tells another request under the same key.
CREATE TABLE requests (
    owner TEXT NOT NULL,
    resource TEXT NOT NULL,
    request_key TEXT NOT NULL,
    digest TEXT NOT NULL,
    id TEXT NOT NULL,
    created_us BIGINT NOT NULL,
    PRIMARY KEY (owner, resource, request_key)
);
CREATE INDEX requests_created ON requests (created_us);
