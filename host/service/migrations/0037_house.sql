-- PostgreSQL tells all services on it of plugins that came, went or changed their state, and of mails to send.
CREATE FUNCTION ocb_told() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_notify(TG_ARGV[0], '');
    RETURN NULL;
END $$;
CREATE TRIGGER ocb_plugins AFTER INSERT OR DELETE ON submissions FOR EACH STATEMENT
    EXECUTE FUNCTION ocb_told('ocb_plugins');
CREATE TRIGGER ocb_plugin_state AFTER UPDATE ON submissions FOR EACH ROW WHEN (OLD.state IS DISTINCT FROM NEW.state)
    EXECUTE FUNCTION ocb_told('ocb_plugins');
CREATE TRIGGER ocb_mails AFTER INSERT ON mails FOR EACH STATEMENT EXECUTE FUNCTION ocb_told('ocb_mails');
