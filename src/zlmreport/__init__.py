"""Calibration certificates for machine axes, from measurements to the printed page."""

__version__ = "0.1.0"
