"""The benchmark of truth: tests that hide a known effect, and what a diagnosis makes of them."""
