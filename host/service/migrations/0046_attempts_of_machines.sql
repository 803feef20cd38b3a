-- What a machine began last says what it is given next.
CREATE INDEX attempts_machine ON attempts (machine, begun_us);
