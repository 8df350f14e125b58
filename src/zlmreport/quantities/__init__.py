"""Units, numbers as they are written, and symbols as they are printed."""
