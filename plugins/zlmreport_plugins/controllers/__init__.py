"""Controls for which compensation tables are written."""
