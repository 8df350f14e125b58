"""Requirements that several standards share, each a function from a test to a `Finding`.

A standard says which of them it asks for, with its own numbers, and where it knows them from.
"""
