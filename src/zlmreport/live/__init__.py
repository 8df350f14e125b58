"""A measurement under way: ports of instruments, a capture along a plan, instruments that are emulated."""
