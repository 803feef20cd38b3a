-- For the lists of plugins, which are cut by the database.
CREATE INDEX submissions_created ON submissions (created_us, id);
CREATE INDEX submissions_blob ON submissions (blob);
