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
from zlmreport_plugins.renderers.pdf_typst.words import (
    collect_symbol,
    fit_text,
    fit_text_with_symbols,
    part_text,
)

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


def collect_contents(certificate: Certificate) -> Data:
    """Return all that is printed, and what the file says of itself."""
    cover, *sections = (
        [_make_block(each, certificate) for each in blocks] for blocks in numbered_blocks(certificate)
    )
    letterhead, words = certificate.printed_letterhead, certificate.page_words
    ended = endings(certificate)
    followed = (*ended[1:], Ending())[: len(ended)]
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
        "title": fit_text(certificate.title, _TITLE, FontFace.SEMIBOLD),
        "subtitle": fit_text(certificate.subtitle, _SUBTITLE),
        "number": fit_text(certificate.number, _SUBTITLE, FontFace.SEMIBOLD),
        "letterhead": _make_letterhead(letterhead) if letterhead else None,
        "small-head": certificate.head == "small",
        "accent": certificate.look.accent,
        "logo": certificate.look.logo,
        "words": {
            "number": fit_text(words.number, _RUNNING_NUMBER),
            "foot": fit_text(words.foot, _RUNNING_NUMBER),
            "page": words.page,
            "of": words.of,
            "end": words.end,
            "head": fit_text(certificate.running_head, _RUNNING_HEAD),
        },
        "cover": cover,
        "sections": [
            {
                "key": section.key,
                "number": str(number),
                "title": fit_text(section.title, _SECTION, FontFace.SEMIBOLD),
                "new-page": section.new_page,
                "kept": ending.kept,
                "leads-on": after.is_joined,
                "blocks": blocks,
            }
            for number, (section, ending, after, blocks) in enumerate(
                zip(certificate.sections, ended, followed, sections, strict=True), start=1
            )
        ],
    }


def list_enclosures(certificate: Certificate) -> list[Data]:
    """Return the files that the document carries."""
    return [
        {
            "name": each.name,
            "content": _make_bytes(each.content),
            "type": each.media_type,
            "relationship": each.relationship.value.lower(),
            "description": each.description,
        }
        for each in certificate.attachments
    ]


def _make_block(numbered: NumberedBlock, certificate: Certificate) -> Data:
    language, is_compact = certificate.language, certificate.is_compact
    match numbered.block:
        case Table(caption=caption, symbols=symbols) as table:
            data = _collect_table(table, is_compact=is_compact)
            return {"kind": "table", **_make_captioned(numbered, caption, symbols), **data}
        case Formulas(caption=caption) as formulas:
            data = _collect_formulas(formulas, is_compact=is_compact)
            return {"kind": "formulas", **_make_captioned(numbered, caption), **data}
        case Graph(figure):
            return {
                "kind": "graph",
                **_make_captioned(numbered, figure.title.in_language(language), figure.symbols),
                "alternative": figure.alternative.in_language(language),
                **collect_graph(figure, language),
            }
        case Paragraph(text, fine=fine, verdict=verdict, symbols=symbols):
            return {
                "kind": "paragraph",
                "text": fit_text_with_symbols(text, symbols, _PAGE / _FINE if fine else _PAGE),
                "fine": fine,
                "verdict": _make_cell(verdict, _PAGE) if verdict else None,
            }
        case Notice(heading, items, is_quoted, symbols):
            return {
                "kind": "notice",
                "quoted": is_quoted,
                "heading": fit_text(heading, _NOTICE, FontFace.REGULAR if is_quoted else FontFace.SEMIBOLD),
                "items": [fit_text_with_symbols(item, symbols, _NOTICE) for item in items],
                "whole": len(heading) + sum(map(len, items)) <= _WHOLE,
            }
        case facts:
            return _make_facts(facts)


def _make_captioned(numbered: NumberedBlock, caption: str, symbols: Iterable[str] = ()) -> Data:
    return {"label": numbered.label, "caption": fit_text_with_symbols(caption, symbols, _CAPTION)}


def _make_facts(groups: tuple[Facts, ...]) -> Data:
    columns = facts_side_by_side(groups)
    for_names, for_values = _FACTS[len(columns)]
    return {
        "kind": "facts",
        "columns": [
            [
                {
                    "heading": fit_text(group.heading, for_names + for_values, FontFace.SEMIBOLD),
                    "pairs": [
                        [fit_text(name, for_names), fit_text(value, for_values, may_be_smaller=True)]
                        for name, value in group.pairs
                    ],
                    "whole": _measure_group(group) <= _WHOLE,
                }
                for group in column
            ]
            for column in columns
        ],
        "whole": sum(map(_measure_group, groups)) <= _WHOLE,
    }


def _measure_group(group: Facts) -> int:
    return sum(len(name) + len(value) for name, value in group.pairs)


def _make_letterhead(letterhead: Letterhead) -> Data:
    return {
        "laboratory": fit_text(letterhead.laboratory.name, _LETTERHEAD, FontFace.SEMIBOLD),
        "lines": [fit_text(line, _LETTERHEAD) for line in letterhead.laboratory.lines],
        "accreditation": fit_text(letterhead.accreditation, _LETTERHEAD),
        "logo": _make_bytes(letterhead.logo) if letterhead.logo else None,
    }


def _make_bytes(content: bytes) -> str | list[int]:
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


def _collect_table(table: Table, *, is_compact: bool) -> dict[str, Any]:
    rows = [row for group in table.groups for row in group.rows]
    columns, rooms = _share_columns(
        table, rows, [column.align for column in table.columns], is_compact=is_compact
    )
    padding = iter(decimal_padding(table))
    return {
        **columns,
        "align": [column.align.value for column in table.columns],
        "headings": [
            {"content": _make_cell(column.heading, room, face=FontFace.SEMIBOLD), "unit": column.unit}
            for column, room in zip(table.columns, rooms, strict=True)
        ],
        "groups": [
            {
                "heading": fit_text(group.heading, _GROUP, FontFace.SEMIBOLD),
                "note": fit_text(group.note, _GROUP),
                "section": group.section,
                "rows": [_make_row(row, rooms, next(padding), table.symbols) for row in group.rows],
            }
            for group in table.groups
        ],
    }


def _collect_formulas(formulas: Formulas, *, is_compact: bool) -> dict[str, Any]:
    """Return definitions, which are set as a table without headings."""
    columns, rooms = _share_columns(formulas, formulas.rows, [Align.LEFT] * 3, is_compact=is_compact)
    return {**columns, "rows": [_make_row(row, rooms) for row in formulas.rows]}


def _share_columns(
    block: Table | Formulas, rows: Iterable[Sequence[Cell]], alignments: Sequence[Align], *, is_compact: bool
) -> tuple[Data, list[float]]:
    """Return how columns share the page, and the width that each leaves for words, in em.

    Columns of numbers were made wide enough for each of them, and never part one.
    """
    layout = table_layout(block, is_compact=is_compact)
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
        "breakable": any(len(_list_words_of(cell)) > _LONG_CELL for row in rows for cell in row),
    }
    return shared, rooms


def _list_words_of(cell: Cell) -> str:
    """Return the words of a cell that may part into lines."""
    if isinstance(cell, Explained):
        return cell.name + cell.meaning
    return cell if isinstance(cell, str) else ""


def _make_row(
    row: Sequence[Cell],
    rooms: Sequence[float],
    padding: Iterable[str] = repeat(""),
    symbols: tuple[str, ...] = (),
) -> list[Any]:
    return [
        _make_cell(cell, room, lacking, symbols=symbols)
        for cell, room, lacking in zip(row, rooms, padding, strict=False)
    ]


def _make_cell(
    cell: Cell,
    room: float,
    padding: str = "",
    face: FontFace = FontFace.REGULAR,
    symbols: tuple[str, ...] = (),
) -> Any:
    """Return a cell: a text as it stands, and what is more than a text with its kind."""
    match cell:
        case Symbol(notation):
            return collect_symbol(notation)
        case Verdict(mark, word):
            return {
                "kind": "verdict",
                "shape": mark.value.replace(" ", "-"),
                "word": fit_text(word, room - _BADGE),
            }
        case Explained(name, meaning):
            return {
                "kind": "explained",
                "name": fit_text(name, room),
                "meaning": fit_text(meaning, room / _SMALL),
            }
        case text if padding:
            return {"kind": "number", "text": text, "gap": _measure_gap(padding)}
        case text if symbols:
            return fit_text_with_symbols(text, symbols, room)
        case text:
            return fit_text(text, room, face)


def _measure_gap(padding: str) -> float:
    """Return how far left of the column's end a number stands, in em, for the decimals that it lacks."""
    kind, _, lacking = padding.partition("-")
    return int(lacking) * _FIGURE + (_DECIMAL_SIGN if kind == "whole" else 0.0)


_FACES = {FontFace.REGULAR: "regular", FontFace.ITALIC: "italic", FontFace.SEMIBOLD: "semibold"}
# A hundredth of a point is 4 µm of paper.
_OPERATORS = {"M": "M%.2f %.2f", "L": "L%.2f %.2f", "C": "C%.2f %.2f %.2f %.2f %.2f %.2f", "Z": "Z"}


def collect_graph(figure: Figure, language: Language) -> Data:
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
        "drawing": canvas.make_image(width, height),
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
            for stretch in part_text(run.text, run.face)
        ]
        self.labels.append([first.x, first.y, angle, hexadecimal_colour(colour), spans])

    def make_image(self, width: float, height: float) -> str:
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
