"""The deviation of an axis over a plane: lines measured at several positions of a second axis."""
