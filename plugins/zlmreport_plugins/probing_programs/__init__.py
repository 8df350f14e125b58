"""Writers of probing programs: a planned path in the language of a measuring machine."""
