"""What is said of a subject, once and as neutral blocks: a fit, a diagnosis, a forecast, a table."""
