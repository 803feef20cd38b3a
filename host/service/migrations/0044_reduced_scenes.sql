-- The recording about the reduced scene, where a replay was asked for one.
ALTER TABLE workloads ADD COLUMN reduced TEXT;
