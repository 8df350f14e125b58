"""The way of the probe over a step gauge: planned, free of collisions, drawn, written for machines."""
