"""Controls that are known from paper, and were never tried: a module for each maker."""
