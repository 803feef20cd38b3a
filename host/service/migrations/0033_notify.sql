-- PostgreSQL tells all services on it of events and of changed states, in the transaction that writes them.
CREATE FUNCTION ocb_event() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_notify('ocb_runs', NEW.run_id);
    RETURN NULL;
END $$;
CREATE TRIGGER ocb_event AFTER INSERT ON run_events FOR EACH ROW EXECUTE FUNCTION ocb_event();

CREATE FUNCTION ocb_state() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_notify('ocb_runs', '');
    RETURN NULL;
END $$;
CREATE TRIGGER ocb_new AFTER INSERT ON runs FOR EACH ROW EXECUTE FUNCTION ocb_state();
CREATE TRIGGER ocb_state AFTER UPDATE ON runs FOR EACH ROW WHEN (OLD.state IS DISTINCT FROM NEW.state)
    EXECUTE FUNCTION ocb_state();
