"""Calibration with a step gauge: a large plugin that uses nothing of zlmreport but its door."""
