"""A certificate as the data that the template ``certificate.typ`` sets.

Everything here is text, numbers and lists of them: nothing is ever read as Typst's markup.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import count
from typing import Any, TypeAlias

from zlmreport.plugin import (
    Attachment,
    Block,
    Certificate,
    Facts,
    FontFace,
    Formulas,
    GatheredBlock,
    Graph,
    Letterhead,
    Notice,
    PageWords,
    Paragraph,
    Section,
    Table,
    facts_side_by_side,
    gather_facts,
)
from zlmreport_plugins.renderers.pdf_typst.graphs import graph_data
from zlmreport_plugins.renderers.pdf_typst.tables import formulas_data, table_data
from zlmreport_plugins.renderers.pdf_typst.words import fitted

#: What JSON knows.
Data: TypeAlias = dict[str, Any]

# Widths of places, in em of their type.
_PAGE = 53.0
_CAPTION = 56.0
_NOTICE = 49.0
_TITLE = 21.0
_SUBTITLE = 40.0
_SECTION = 34.0
_LETTERHEAD = 34.0
_RUNNING_NUMBER = 47.0
_RUNNING_HEAD = 34.0
#: Of the names and the values of facts, by the number of columns.
_FACTS = {1: (15.0, 36.0), 2: (10.0, 13.5)}
#: Characters of facts, or of a notice, that stay on one page for certain.
_WHOLE = 2000


def contents(certificate: Certificate) -> Data:
    """Return all that is printed, and what the file says of itself."""
    compositor = _Compositor(certificate)
    letterhead = certificate.letterhead
    return {
        "language": certificate.language.value,
        "paper": certificate.paper,
        "compact": certificate.is_compact,
        "file": {
            "title": f"{certificate.title} {certificate.number}",
            "author": letterhead.laboratory.name if letterhead else "",
            "description": certificate.description,
            "keywords": certificate.keywords,
        },
        "title": fitted(certificate.title, _TITLE, FontFace.SEMIBOLD),
        "subtitle": fitted(certificate.subtitle, _SUBTITLE),
        "number": fitted(certificate.number, _SUBTITLE, FontFace.SEMIBOLD),
        "letterhead": _letterhead(letterhead) if letterhead else None,
        "accent": certificate.look.accent,
        "logo": certificate.look.logo,
        "words": {
            **_words(certificate.page_words),
            "head": fitted(certificate.running_head, _RUNNING_HEAD),
        },
        "cover": compositor.blocks(certificate.cover),
        "sections": [
            compositor.section(number, section)
            for number, section in enumerate(certificate.sections, start=1)
        ],
    }


def enclosures(certificate: Certificate) -> list[Data]:
    """Return the files that the document carries."""
    return list(map(_enclosure, certificate.attachments))


class _Compositor:
    """Turns the parts of one document into data, and counts its tables and figures."""

    def __init__(self, certificate: Certificate) -> None:
        self._language = certificate.language
        self._words = certificate.page_words
        self._tables = count(1)
        self._figures = count(1)

    def section(self, number: int, section: Section) -> Data:
        return {
            "key": section.key,
            "number": str(number),
            "title": fitted(section.title, _SECTION, FontFace.SEMIBOLD),
            "new-page": section.new_page,
            "blocks": self.blocks(section.blocks),
        }

    def blocks(self, blocks: Iterable[Block]) -> list[Data]:
        return [self._block(block) for block in gather_facts(blocks)]

    def _block(self, block: GatheredBlock) -> Data:
        match block:
            case Table(caption=caption):
                return {"kind": "table", **self._table_caption(caption), **table_data(block)}
            case Formulas(caption=caption):
                return {"kind": "formulas", **self._table_caption(caption), **formulas_data(block)}
            case Graph():
                return self._graph(block)
            case Paragraph(text):
                return {"kind": "paragraph", "text": fitted(text, _PAGE)}
            case Notice(heading, items):
                return {
                    "kind": "notice",
                    "heading": fitted(heading, _NOTICE, FontFace.SEMIBOLD),
                    "items": [fitted(item, _NOTICE) for item in items],
                    "whole": len(heading) + sum(map(len, items)) <= _WHOLE,
                }
            case facts:
                return _facts(facts)

    def _graph(self, graph: Graph) -> Data:
        figure = graph.figure
        return {
            "kind": "graph",
            "label": f"{self._words.figure} {next(self._figures)}".strip(),
            "caption": fitted(figure.title.in_language(self._language), _CAPTION),
            "alternative": figure.alternative.in_language(self._language),
            **graph_data(figure, self._language),
        }

    def _table_caption(self, caption: str) -> Data:
        return {
            "label": f"{self._words.table} {next(self._tables)}".strip(),
            "caption": fitted(caption, _CAPTION),
        }


def _facts(groups: tuple[Facts, ...]) -> Data:
    columns = facts_side_by_side(groups)
    for_names, for_values = _FACTS[len(columns)]
    return {
        "kind": "facts",
        "columns": [
            [
                {
                    "heading": fitted(group.heading, for_names + for_values, FontFace.SEMIBOLD),
                    "pairs": [
                        [fitted(name, for_names), fitted(value, for_values)] for name, value in group.pairs
                    ],
                    "whole": _length(group) <= _WHOLE,
                }
                for group in column
            ]
            for column in columns
        ],
        "whole": sum(map(_length, groups)) <= _WHOLE,
    }


def _length(group: Facts) -> int:
    return sum(len(name) + len(value) for name, value in group.pairs)


def _letterhead(letterhead: Letterhead) -> Data:
    return {
        "laboratory": fitted(letterhead.laboratory.name, _LETTERHEAD, FontFace.SEMIBOLD),
        "lines": [fitted(line, _LETTERHEAD) for line in letterhead.laboratory.lines],
        "accreditation": fitted(letterhead.accreditation, _LETTERHEAD),
        "logo": _bytes(letterhead.logo) if letterhead.logo else None,
    }


def _words(words: PageWords) -> Data:
    return {
        "number": fitted(words.number, _RUNNING_NUMBER),
        "foot": fitted(words.foot, _RUNNING_NUMBER),
        "page": words.page,
        "of": words.of,
        "end": words.end,
    }


def _enclosure(attachment: Attachment) -> Data:
    return {
        "name": attachment.name,
        "content": _bytes(attachment.content),
        "type": attachment.media_type,
        "relationship": attachment.relationship.value.lower(),
        "description": attachment.description,
    }


def _bytes(content: bytes) -> str | list[int]:
    """Return bytes as JSON can hold them: as the text that they are, or one by one."""
    try:
        return content.decode()
    except UnicodeDecodeError:
        return list(content)
