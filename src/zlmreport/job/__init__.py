"""Job files: from YAML with line numbers to a checked, frozen job."""
