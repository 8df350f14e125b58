"""Statistics by position, requirements, decision rules, corrections, uncertainty; warnings on readings."""
