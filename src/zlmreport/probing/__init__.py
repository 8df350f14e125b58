"""Probing machines, over I++ DME: the planned path is run, and its points are collected."""
