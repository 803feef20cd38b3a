//! Tests that see every floor.
