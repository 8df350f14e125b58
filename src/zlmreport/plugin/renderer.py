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
    split_at_symbols as with_symbols,
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
    balance_facts as facts_side_by_side,
    lay_out_table as table_layout,
    number_blocks as numbered_blocks,
    pad_decimals as decimal_padding,
)
from zlmreport.document.certificate.conditions import (
    Described,
)
from zlmreport.document.certificate.conformity import (
    STATEMENTS as CONFORMITY_STATEMENTS,
)
from zlmreport.document.certificate.cover import (
    place_of_work,
    split_address as address_lines,
)
from zlmreport.document.certificate.digest import DIGEST
from zlmreport.document.certificate.document import Certificate, Letterhead, Look, PageWords
from zlmreport.document.certificate.endings import Ending, find_endings as endings
from zlmreport.document.certificate.statements import (
    say_traceable_through as traceable_through,
)
from zlmreport.document.writer import (
    Writer,
)
from zlmreport.evaluation.evaluation import (
    Decision,
    EvaluatedParameter,
    compare_parameters as changes,
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
    round_pair as rounded_pair,
    split_spans as notation_spans,
)
from zlmreport.plugin.protocols import (
    Renderer,
)

__all__ = [
    "CONFORMITY_STATEMENTS",
    "COVERAGE_PROBABILITY",
    "DIGEST",
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
    "rounded_pair",
    "table_layout",
    "traceable_through",
    "with_symbols",
]
