-- In how many primitive tests each triangle took part; absent where nothing was counted.
ALTER TABLE results ADD COLUMN triangle_tests TEXT REFERENCES blobs (sha256);
