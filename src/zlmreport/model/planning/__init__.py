"""A test before it is done: target positions, and the order in which a positioning method visits them."""
