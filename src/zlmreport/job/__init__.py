"""Job files: from YAML with line numbers to a checked, frozen job; and changes of a file in place."""
