"""The error model of an axis: effects, their fit, where it fails, and which effect is missing."""
