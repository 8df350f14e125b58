"""The workbench: the loop of the error model as a local web page."""
