"""Built-in part programs."""
