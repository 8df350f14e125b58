"""From measured deviations to a compensation table, its forecast, and whether a second test confirms it."""
