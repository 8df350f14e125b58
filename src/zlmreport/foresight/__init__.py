"""A test before it is done: what a job's plan comes to, and what it will be able to see."""
