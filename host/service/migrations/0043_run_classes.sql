-- The hardware class that a run names; without one it is measured on the usual class of the service.
ALTER TABLE runs ADD COLUMN hardware_class TEXT;
