"""Graphs as data, and the one module that draws them."""
