"""What is said and how it looks: certificates as blocks, graphs as data, typesetting, signing."""
