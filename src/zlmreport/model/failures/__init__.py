"""Where a model fails: tests of its residuals, each with what it shows in plain words."""
