"""The numbers of a certificate for programs: as JSON, as a table of one value a row, as a workbook."""

from __future__ import annotations

from zlmreport.plugin import hookimpl
from zlmreport.plugin.renderer import Renderer
from zlmreport_plugins.renderers.json_results.document import JsonResultsRenderer
from zlmreport_plugins.renderers.json_results.tables import CsvRenderer, XlsxRenderer


@hookimpl
def zlmreport_renderers() -> list[Renderer]:
    """Offer the renderers."""
    return [JsonResultsRenderer(), CsvRenderer(), XlsxRenderer()]
