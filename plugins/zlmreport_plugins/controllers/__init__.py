"""Controls for which compensation tables are written: one page each."""
