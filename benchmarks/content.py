"""What a certificate says, as plain data: the same words, numbers and curves for another writer.

A symbol is handed over as the markup that anybody would type for it, a table as rows of text; so the
plain recipe is spared all work that is not setting a page.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from html import escape
from itertools import count
from typing import Any

from zlmreport.document.blocks import (
    Block,
    Cell,
    Explained,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.document.certificate.document import Certificate, PageWords
from zlmreport.document.figures.figure import Figure, Panel
from zlmreport.language import Language, Words
from zlmreport.language.formatting import Span, split_spans, write_plain

Content = dict[str, Any]


def content(certificate: Certificate) -> Content:
    """Return everything that stands in a certificate, as values of JSON."""
    writer = _Writer(certificate.language, certificate.page_words)
    letterhead = certificate.letterhead
    words = certificate.page_words
    return {
        "language": certificate.language.value,
        "title": certificate.title,
        "subtitle": certificate.subtitle,
        "number": certificate.number,
        "running_number": words.number,
        "page": words.page,
        "of": words.of,
        "end": words.end,
        "paper": certificate.paper,
        "laboratory": letterhead.laboratory.name if letterhead else "",
        "address": letterhead.laboratory.lines if letterhead else (),
        "accreditation": letterhead.accreditation if letterhead else "",
        "cover": list(writer.blocks(certificate.cover)),
        "sections": [
            {
                "title": section.title,
                "new_page": section.new_page,
                "blocks": list(writer.blocks(section.blocks)),
            }
            for section in certificate.sections
        ],
    }


@dataclass
class _Writer:
    """Writes blocks in reading order, and counts tables and figures."""

    language: Language
    words: PageWords
    tables: Iterator[int] = field(default_factory=lambda: count(1))
    figures: Iterator[int] = field(default_factory=lambda: count(1))

    def blocks(self, blocks: Iterable[Block]) -> Iterator[Content]:
        return map(self._block, blocks)

    def _block(self, block: Block) -> Content:
        match block:
            case Table():
                return {"kind": "table", "label": self._table_label(), **_table(block)}
            case Formulas(caption, rows):
                markup = [[_markup(cell) for cell in row] for row in rows]
                return {"kind": "formulas", "label": self._table_label(), "caption": caption, "rows": markup}
            case Facts(pairs, heading):
                return {"kind": "facts", "heading": heading, "pairs": pairs}
            case Notice(heading, items):
                return {"kind": "notice", "heading": heading, "items": items}
            case Paragraph(text):
                return {"kind": "paragraph", "text": text}
            case Graph(figure):
                label = f"{self.words.figure} {next(self.figures)}"
                return {"kind": "graph", "label": label, **_figure(figure, self.language)}

    def _table_label(self) -> str:
        return f"{self.words.table} {next(self.tables)}"


def _table(table: Table) -> Content:
    return {
        "caption": table.caption,
        "dense": table.dense,
        "columns": [
            {"heading": _markup(column.heading), "unit": column.unit, "align": column.align.value}
            for column in table.columns
        ],
        "groups": [
            {
                "heading": group.heading,
                "note": group.note,
                "rows": [[_markup(cell) for cell in row] for row in group.rows],
            }
            for group in table.groups
        ],
    }


def _figure(figure: Figure, language: Language) -> Content:
    def say(words: Words | None) -> str:
        return words.in_language(language) if words else ""

    return {
        "caption": say(figure.title),
        "alternative": say(figure.alternative),
        "x_title": f"{say(figure.x_title)} / {figure.x_unit}",
        "y_title": f"{say(figure.y_title)} / {figure.y_unit}",
        "panels": [{"heading": say(panel.heading), **_panel(panel)} for panel in figure.panels],
    }


def _panel(panel: Panel) -> Content:
    return {
        "readings": [
            {"approach": readings.approach.name, "x": readings.x.tolist(), "y": readings.y.tolist()}
            for readings in panel.readings
        ],
        "bands": [
            {
                "label": write_plain(band.notation),
                "role": band.role.name,
                "x": band.x.tolist(),
                "lower": band.lower.tolist(),
                "upper": band.upper.tolist(),
            }
            for band in panel.bands
        ],
        "curves": [
            {
                "label": write_plain(curve.notation),
                "role": curve.role.name,
                "x": curve.x.tolist(),
                "y": curve.y.tolist(),
            }
            for curve in panel.curves
        ],
        "levels": [
            {"label": write_plain(level.notation), "role": level.role.name, "y": level.y}
            for level in panel.levels
        ],
        "arrows": [
            {"label": write_plain(arrow.notation), "x": arrow.x, "low": arrow.low, "high": arrow.high}
            for arrow in panel.arrows
        ],
        "brackets": [
            {
                "label": write_plain(bracket.notation),
                "low": bracket.low,
                "high": bracket.high,
                "low_at": bracket.low_at,
                "high_at": bracket.high_at,
            }
            for bracket in panel.brackets
        ],
    }


def _markup(cell: Cell) -> str:
    match cell:
        case Symbol(notation):
            return "".join(map(_span, split_spans(notation)))
        case Verdict(word=word):
            return escape(word)
        case Explained(name, meaning):
            return f"{escape(name)}<br><small>{escape(meaning)}</small>"
        case _:
            return escape(cell)


def _span(span: Span) -> str:
    text = f"<i>{escape(span.text)}</i>" if span.italic else escape(span.text)
    return f"<sub>{text}</sub>" if span.subscript else text
