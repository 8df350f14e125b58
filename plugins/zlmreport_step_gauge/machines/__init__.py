"""Measuring machines over I++ DME: led along a path, and emulated."""
