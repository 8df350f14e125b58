"""Instruments that are not there: an axis that moves, and devices that speak of it as the real ones do."""
