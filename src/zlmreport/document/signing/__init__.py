"""Signing a finished PDF, and telling whether a signed one is still as it was: pyHanko's only user."""
