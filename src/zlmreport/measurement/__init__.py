"""What was measured: readings in the order in which they were taken, with their conditions and origin."""
