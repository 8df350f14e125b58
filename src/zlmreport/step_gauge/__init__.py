"""Calibration with a step gauge: the gauge, where it lies, and what its faces tell of the axis."""
