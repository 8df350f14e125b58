"""The door of data sources: texts with places, readings, and journals of captures."""

from __future__ import annotations

from zlmreport.measurement.axis import (
    refuse_other_than_positions,
)
from zlmreport.measurement.collect import (
    Reading,
    cap_problems,
    collect as collect_readings,
    is_run as is_run_number,
    say_no_run as no_run_number,
)
from zlmreport.measurement.provenance import (
    Averaging,
    Correction,
    Provenance,
    ReadingDays,
    SourceFile,
)
from zlmreport.measurement.text_file import (
    TextCell,
    TextFile,
    list_likely_encodings as likely_encodings,
    list_sheets_of as sheets_of,
    parse_number,
    read_text,
    require_known_encoding as known_encoding,
)
from zlmreport.plugin.protocols import (
    DataSource,
    SourceContext,
    SourceProposal,
)

__all__ = [
    "Averaging",
    "Correction",
    "DataSource",
    "Provenance",
    "Reading",
    "ReadingDays",
    "SourceContext",
    "SourceFile",
    "SourceProposal",
    "TextCell",
    "TextFile",
    "cap_problems",
    "collect_readings",
    "is_run_number",
    "known_encoding",
    "likely_encodings",
    "no_run_number",
    "parse_number",
    "read_text",
    "refuse_other_than_positions",
    "sheets_of",
]
