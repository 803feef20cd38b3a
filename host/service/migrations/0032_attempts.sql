-- Attempts at work. A job (a run, a stability run, a submitted plugin or advice) has one current attempt at most, which has not
-- ended. Its worker renews the lease; the view database_clock, which each database defines in its own words, says when it is over.
CREATE TABLE attempts (
    id TEXT PRIMARY KEY,
    kind TEXT NOT NULL,
    job TEXT NOT NULL,
    number BIGINT NOT NULL,
    class TEXT NOT NULL,
    machine TEXT NOT NULL,
    begun_us BIGINT NOT NULL,
    lease_us BIGINT NOT NULL,
    ended_us BIGINT,
    outcome TEXT,
    UNIQUE (kind, job, number)
);
CREATE UNIQUE INDEX attempts_current ON attempts (kind, job) WHERE ended_us IS NULL;
CREATE INDEX attempts_job ON attempts (job);

-- What an earlier version was working on: it has ended, and these leases with it.
INSERT INTO attempts (id, kind, job, number, class, machine, begun_us, lease_us)
    SELECT 'before:' || id, 'measure', id, 1, '', '', 0, 0 FROM runs WHERE state = 'running';
INSERT INTO attempts (id, kind, job, number, class, machine, begun_us, lease_us)
    SELECT 'before:' || id, 'check', id, 1, '', '', 0, 0 FROM submissions WHERE state = 'vetted';
