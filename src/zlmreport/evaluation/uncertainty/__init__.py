"""The uncertainty of the measuring set-up, and what it makes of every parameter of every standard."""
