-- Of an account that was deleted the row stays, because plugins of the public record lead to it: it opens nothing, is called
-- 'a former account', and its name is given to nobody, of whom the audit log would speak then.
ALTER TABLE accounts ADD COLUMN deleted_us BIGINT;
