"""The live instruments that come with zlmreport: µMD, ND 28x, IDS3010, and any display of text."""
