-- When a guest last asked that what they made be kept longer.
CREATE TABLE kept (
    owner TEXT PRIMARY KEY,
    asked_us BIGINT NOT NULL
);
