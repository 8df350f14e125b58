"""The formats that come with zlmreport: PDF by two ways, HTML, JSON, CSV, a workbook, DCC."""
