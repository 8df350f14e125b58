"""What a live instrument gives, and what all instruments share: ports, lines, the rhythm of questions."""
