"""The live instruments that come with zlmreport."""
