"""The standards that come with zlmreport: ISO 230-1 to -4 and -6, NMTBA, VDI, the union jack."""
