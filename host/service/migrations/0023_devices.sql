-- From which browsers an account was entered: who tries its name from everywhere must not keep its owner out of these.
CREATE TABLE devices (
    account TEXT NOT NULL,
    sha256 TEXT NOT NULL,
    entered_us BIGINT NOT NULL,
    PRIMARY KEY (account, sha256)
);
