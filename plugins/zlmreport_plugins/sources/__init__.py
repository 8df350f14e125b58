"""The data sources that come with zlmreport: tables, loggers, circles, plates, Renishaw, ecmc, journals."""
