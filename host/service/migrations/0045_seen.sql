-- What machines have found so far of the runs that they measure, for the services that do not hear from these machines. It need not
-- outlive a crash of the database.
CREATE UNLOGGED TABLE seen (
    run_id TEXT NOT NULL REFERENCES runs (id) ON DELETE CASCADE,
    place BIGINT NOT NULL,
    attempt TEXT NOT NULL,
    service TEXT NOT NULL,
    seen TEXT NOT NULL,
    PRIMARY KEY (run_id, place)
);
CREATE FUNCTION ocb_seen() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_notify('ocb_seen', NEW.run_id || ' ' || NEW.place || ' ' || NEW.attempt || ' ' || NEW.service);
    RETURN NULL;
END $$;
CREATE TRIGGER ocb_seen AFTER INSERT OR UPDATE ON seen FOR EACH ROW EXECUTE FUNCTION ocb_seen();

-- It goes with its attempt.
CREATE FUNCTION ocb_unseen() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    DELETE FROM seen WHERE attempt = NEW.id;
    RETURN NULL;
END $$;
CREATE TRIGGER ocb_unseen AFTER UPDATE ON attempts FOR EACH ROW
    WHEN (OLD.ended_us IS NULL AND NEW.ended_us IS NOT NULL) EXECUTE FUNCTION ocb_unseen();
