"""What is said of a machine, once and as blocks; terminal, page and document only lay it out."""
