"""A fleet's certificates: which are due, making them, and what became of each."""
