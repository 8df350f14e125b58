"""Built-in standards."""
