"""The certificate as a document: its sections and what stands in them, without a layout."""
