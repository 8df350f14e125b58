"""Ports and what is spoken over them: the readings of a live instrument."""
