"""Readings recomputed from what the instrument displayed: index of air, dead path, expansion to 20 °C."""
