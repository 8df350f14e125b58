"""The door of formats: the document and its blocks."""

from __future__ import annotations

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    Explained,
    Facts,
    Formulas,
    Graph,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
    Verdict,
    with_symbols,
)
from zlmreport.document.certificate.attachments import (
    Attachment,
    Relationship,
    Source as CertificateSource,
)
from zlmreport.document.certificate.circumstances import (
    Fact,
)
from zlmreport.document.certificate.columns import (
    NumberedBlock,
    decimal_padding,
    numbered as numbered_blocks,
    side_by_side as facts_side_by_side,
    table_layout,
)
from zlmreport.document.certificate.conditions import (
    Described,
)
from zlmreport.document.certificate.conformity import (
    STATEMENTS as CONFORMITY_STATEMENTS,
)
from zlmreport.document.certificate.cover import (
    lines as address_lines,
    place_of_work,
)
from zlmreport.document.certificate.digest import DIGEST
from zlmreport.document.certificate.document import Certificate, Letterhead, Look, PageWords
from zlmreport.document.certificate.endings import Ending, endings
from zlmreport.document.certificate.statements import (
    TRACEABLE,
)
from zlmreport.document.writer import (
    Writer,
)
from zlmreport.evaluation.evaluation import (
    Decision,
    Parameter as EvaluatedParameter,
    changes,
)
from zlmreport.evaluation.report import (
    report_changes,
    report_evaluation,
)
from zlmreport.evaluation.uncertainty.budget import (
    COVERAGE_PROBABILITY,
    Budget,
    NoBudget,
)
from zlmreport.job.document_keys import (
    Customer,
    Laboratory,
)
from zlmreport.language.formatting import (
    spans as notation_spans,
)
from zlmreport.plugin.protocols import (
    Renderer,
)

__all__ = [
    "CONFORMITY_STATEMENTS",
    "COVERAGE_PROBABILITY",
    "DIGEST",
    "TRACEABLE",
    "Align",
    "Attachment",
    "Block",
    "Budget",
    "Cell",
    "Certificate",
    "CertificateSource",
    "Column",
    "Customer",
    "Decision",
    "Described",
    "Ending",
    "EvaluatedParameter",
    "Explained",
    "Fact",
    "Facts",
    "Formulas",
    "Graph",
    "Laboratory",
    "Letterhead",
    "Look",
    "Mark",
    "NoBudget",
    "Notice",
    "NumberedBlock",
    "PageWords",
    "Paragraph",
    "Relationship",
    "Renderer",
    "RowGroup",
    "Section",
    "Symbol",
    "Table",
    "Verdict",
    "Writer",
    "address_lines",
    "changes",
    "decimal_padding",
    "endings",
    "facts_side_by_side",
    "notation_spans",
    "numbered_blocks",
    "place_of_work",
    "report_changes",
    "report_evaluation",
    "table_layout",
    "with_symbols",
]
