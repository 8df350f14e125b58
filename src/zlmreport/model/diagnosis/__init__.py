"""Where a model fails, and which effect is missing."""
