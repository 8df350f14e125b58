"""Graphs as data, their layout, and the one drawing of them."""
