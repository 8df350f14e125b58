"""A certificate as the data that the template ``certificate.typ`` sets.

Everything here is text, numbers and lists of them: nothing is ever read as Typst's markup.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from itertools import repeat
from math import inf
from typing import Any, TypeAlias

from zlmreport.plugin import Figure, Language
from zlmreport.plugin.page import (
    Colour,
    Fill,
    FontFace,
    Segment,
    Stroke,
    TextRun,
    draw_figure,
    figure_size,
    hexadecimal_colour,
)
from zlmreport.plugin.renderer import (
    Align,
    Cell,
    Certificate,
    Ending,
    Explained,
    Facts,
    Formulas,
    Graph,
    Letterhead,
    Notice,
    NumberedBlock,
    Paragraph,
    Symbol,
    Table,
    Verdict,
    decimal_padding,
    endings,
    facts_side_by_side,
    numbered_blocks,
    table_layout,
)
from zlmreport_plugins.renderers.pdf_typst.words import fitted, fitted_with_symbols, parted, symbol_data

#: What JSON knows.
Data: TypeAlias = dict[str, Any]

# Widths of places, in em of their type.
_PAGE = 53.0
#: Of type in which the law is quoted.
_FINE = 0.765
_CAPTION = 56.0
_NOTICE = 49.0
_TITLE = 21.0
_SUBTITLE = 40.0
_SECTION = 34.0
_LETTERHEAD = 34.0
_RUNNING_NUMBER = 54.0
_RUNNING_HEAD = 34.0
#: Of the names and the values of facts, by the number of columns.
_FACTS = {1: (15.0, 36.0), 2: (10.4, 13.5)}
#: Characters of facts, or of a notice, that stay on one page for certain.
_WHOLE = 2000


def contents(certificate: Certificate) -> Data:
    """Return all that is printed, and what the file says of itself."""
    cover, *sections = (
        [_block(each, certificate.language) for each in blocks] for blocks in numbered_blocks(certificate)
    )
    letterhead, words = certificate.letterhead, certificate.page_words
    ended = endings(certificate)
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
            "number": fitted(words.number, _RUNNING_NUMBER),
            "foot": fitted(words.foot, _RUNNING_NUMBER),
            "page": words.page,
            "of": words.of,
            "end": words.end,
            "head": fitted(certificate.running_head, _RUNNING_HEAD),
        },
        "cover": cover,
        "sections": [
            {
                "key": section.key,
                "number": str(number),
                "title": fitted(section.title, _SECTION, FontFace.SEMIBOLD),
                "new-page": section.new_page,
                "kept": ending.kept,
                "leads-on": after.is_joined,
                "blocks": blocks,
            }
            for number, (section, ending, after, blocks) in enumerate(
                zip(certificate.sections, ended, (*ended[1:], Ending()), sections, strict=True), start=1
            )
        ],
    }


def enclosures(certificate: Certificate) -> list[Data]:
    """Return the files that the document carries."""
    return [
        {
            "name": each.name,
            "content": _bytes(each.content),
            "type": each.media_type,
            "relationship": each.relationship.value.lower(),
            "description": each.description,
        }
        for each in certificate.attachments
    ]


def _block(numbered: NumberedBlock, language: Language) -> Data:
    match numbered.block:
        case Table(caption=caption, symbols=symbols) as table:
            return {"kind": "table", **_captioned(numbered, caption, symbols), **table_data(table)}
        case Formulas(caption=caption) as formulas:
            return {"kind": "formulas", **_captioned(numbered, caption), **formulas_data(formulas)}
        case Graph(figure):
            return {
                "kind": "graph",
                **_captioned(numbered, figure.title.in_language(language), figure.symbols),
                "alternative": figure.alternative.in_language(language),
                **graph_data(figure, language),
            }
        case Paragraph(text, fine=fine, verdict=verdict, symbols=symbols):
            return {
                "kind": "paragraph",
                "text": fitted_with_symbols(text, symbols, _PAGE / _FINE if fine else _PAGE),
                "fine": fine,
                "verdict": _cell(verdict, _PAGE) if verdict else None,
            }
        case Notice(heading, items, is_quoted):
            return {
                "kind": "notice",
                "quoted": is_quoted,
                "heading": fitted(heading, _NOTICE, FontFace.REGULAR if is_quoted else FontFace.SEMIBOLD),
                "items": [fitted(item, _NOTICE) for item in items],
                "whole": len(heading) + sum(map(len, items)) <= _WHOLE,
            }
        case facts:
            return _facts(facts)


def _captioned(numbered: NumberedBlock, caption: str, symbols: Iterable[str] = ()) -> Data:
    return {"label": numbered.label, "caption": fitted_with_symbols(caption, symbols, _CAPTION)}


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


def _bytes(content: bytes) -> str | list[int]:
    """Return bytes as JSON can hold them: as the text that they are, or one by one."""
    try:
        return content.decode()
    except UnicodeDecodeError:
        return list(content)


#: Width of a figure, and of a decimal sign, in em: all figures of the typeface are of one width.
_FIGURE = 0.6
_DECIMAL_SIGN = 0.272

#: Space at both sides of a cell, further space before words after numbers, and the mark of a verdict, in em.
_PADDING = 0.9
_APART = 1.15
_BADGE = 1.5
#: Size of the small type below a name.
_SMALL = 0.9
#: Width of a group's heading.
_GROUP = 50.0
#: Characters of a cell that fits on a page for certain.
_LONG_CELL = 400


def table_data(table: Table) -> dict[str, Any]:
    """Return the columns and rows of a table."""
    rows = [row for group in table.groups for row in group.rows]
    columns, rooms = _columns(table, rows, [column.align for column in table.columns])
    padding = iter(decimal_padding(table))
    return {
        **columns,
        "align": [column.align.value for column in table.columns],
        "headings": [
            {"content": _cell(column.heading, room, face=FontFace.SEMIBOLD), "unit": column.unit}
            for column, room in zip(table.columns, rooms, strict=True)
        ],
        "groups": [
            {
                "heading": fitted(group.heading, _GROUP, FontFace.SEMIBOLD),
                "note": fitted(group.note, _GROUP),
                "section": group.section,
                "rows": [_row(row, rooms, next(padding)) for row in group.rows],
            }
            for group in table.groups
        ],
    }


def formulas_data(formulas: Formulas) -> dict[str, Any]:
    """Return definitions, which are set as a table without headings."""
    columns, rooms = _columns(formulas, formulas.rows, [Align.LEFT] * 3)
    return {**columns, "rows": [_row(row, rooms) for row in formulas.rows]}


def _columns(
    block: Table | Formulas, rows: Iterable[Sequence[Cell]], alignments: Sequence[Align]
) -> tuple[Data, list[float]]:
    """Return how columns share the page, and the width that each leaves for words, in em.

    Columns of numbers were made wide enough for each of them, and never part one.
    """
    layout = table_layout(block)
    rooms = [
        inf if align is Align.RIGHT else room - _PADDING - (_APART if apart else 0.0)
        for room, align, apart in zip(layout.rooms, alignments, layout.apart, strict=True)
    ]
    shared = {
        "size": layout.size,
        "widths": layout.widths,
        "apart": layout.apart,
        "whole": layout.is_whole,
        "in-fives": layout.in_fives,
        "breakable": any(len(_words_of(cell)) > _LONG_CELL for row in rows for cell in row),
    }
    return shared, rooms


def _words_of(cell: Cell) -> str:
    """Return the words of a cell that may part into lines."""
    if isinstance(cell, Explained):
        return cell.name + cell.meaning
    return cell if isinstance(cell, str) else ""


def _row(row: Sequence[Cell], rooms: Sequence[float], padding: Iterable[str] = repeat("")) -> list[Any]:
    return [_cell(cell, room, lacking) for cell, room, lacking in zip(row, rooms, padding, strict=False)]


def _cell(cell: Cell, room: float, padding: str = "", face: FontFace = FontFace.REGULAR) -> Any:
    """Return a cell: a text as it stands, and what is more than a text with its kind."""
    match cell:
        case Symbol(notation):
            return symbol_data(notation)
        case Verdict(mark, word):
            return {
                "kind": "verdict",
                "shape": mark.value.replace(" ", "-"),
                "word": fitted(word, room - _BADGE),
            }
        case Explained(name, meaning):
            return {
                "kind": "explained",
                "name": fitted(name, room),
                "meaning": fitted(meaning, room / _SMALL),
            }
        case text if padding:
            return {"kind": "number", "text": text, "gap": _gap(padding)}
        case text:
            return fitted(text, room, face)


def _gap(padding: str) -> float:
    """Return how far left of the column's end a number stands, in em, for the decimals that it lacks."""
    kind, _, lacking = padding.partition("-")
    return int(lacking) * _FIGURE + (_DECIMAL_SIGN if kind == "whole" else 0.0)


_FACES = {FontFace.REGULAR: "regular", FontFace.ITALIC: "italic", FontFace.SEMIBOLD: "semibold"}
# A hundredth of a point is 4 µm of paper.
_OPERATORS = {"M": "M%.2f %.2f", "L": "L%.2f %.2f", "C": "C%.2f %.2f %.2f %.2f %.2f %.2f", "Z": "Z"}


def graph_data(figure: Figure, language: Language) -> Data:
    """Return a figure's drawing: its size in points, all outlines as one SVG image, and over it the labels.

    Typst sets the labels as it sets every other text, so a symbol such as x̄ is one letter to whoever searches
    or copies it. In an SVG image its bar would be a shape without a meaning.
    """
    width, height = figure_size(figure)
    canvas = GraphCanvas()
    draw_figure(figure, language, canvas)
    return {
        "width": width,
        "height": height,
        "drawing": canvas.image(width, height),
        "labels": canvas.labels,
    }


class GraphCanvas:
    """A canvas that keeps outlines and text apart."""

    def __init__(self) -> None:
        self._paths: list[str] = []
        #: Each line of text in the order in which it was set: x and y of its beginning, angle, colour, and
        #: its runs, each with face, size, how far it lies below the first, and a stretch of text.
        self.labels: list[list[Any]] = []

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Add a path."""
        del kind
        data = "".join([_OPERATORS[operator] % points for operator, points in segments])
        self._paths.append(f'<path d="{data}"{_look(stroke, fill)}/>')

    def text(self, kind: str, runs: Sequence[TextRun], colour: Colour, angle: float) -> None:
        """Keep a line of text."""
        del kind
        first = runs[0]
        spans = [
            [_FACES[run.face], run.size, run.y - first.y, *stretch]
            for run in runs
            for stretch in parted(run.text, run.face)
        ]
        self.labels.append([first.x, first.y, angle, hexadecimal_colour(colour), spans])

    def image(self, width: float, height: float) -> str:
        """Return the outlines as an SVG image of a size in points."""
        size = f'width="{width}pt" height="{height}pt" viewBox="0 0 {width} {height}"'
        return "".join((f'<svg xmlns="http://www.w3.org/2000/svg" {size}>', *self._paths, "</svg>"))


@cache
def _look(stroke: Stroke | None, fill: Fill | None) -> str:
    """Return the attributes of a path: a drawing has a few looks, and they come again and again."""
    inside = (
        f' fill="{hexadecimal_colour(fill.colour)}" fill-opacity="{fill.opacity}"' if fill else ' fill="none"'
    )
    if stroke is None:
        return inside
    dashes = f' stroke-dasharray="{" ".join(map(str, stroke.dashes))}"' if stroke.dashes else ""
    return f'{inside} stroke="{hexadecimal_colour(stroke.colour)}" stroke-width="{stroke.width}"{dashes}'
