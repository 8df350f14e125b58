"""Whether a certificate holds: all of it against what its own attachments give when evaluated again."""
