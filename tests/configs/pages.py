"""What a page may not be: nearly empty, ending on a heading, parting what belongs together, cut off."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pypdfium2

from zlmreport.document.certificate.columns import lay_out_table, write_cell_text
from zlmreport.plugin.renderer import Certificate, Facts, Formulas, Notice, Paragraph, Symbol, Table

#: Points from the edge of a page in which its head and its foot stand, and its margin at the sides.
_HEAD, _FOOT, _SIDE = 58.0, 52.0, 55.0
#: The least part of a page that is filled; of the last page, unless what stands on it had to begin there, and
#: of several measurements in one document, of each of which the last page may be that short.
_LEAST_FILL, _LEAST_END = 0.35, 0.2
#: Points between a rule and what it belongs to, at most.
_APART = 8


def embarrassments(certificate: Certificate, pdf: bytes) -> list[str]:
    """Return what nobody would put his name on, page by page."""
    document = pypdfium2.PdfDocument(pdf)
    pages = list(document)
    bodies = [
        _lines(page, _FOOT, page.get_height() - (_HEAD if number else 40))
        for number, page in enumerate(pages)
    ]
    return [
        *(
            f"page {number} is filled to {fill:.2f}"
            for number, fill in _emptiness(certificate, pages, bodies)
        ),
        *(f"page 1 is without {text!r}" for text in _missing_on_the_first(certificate, bodies[0])),
        *(f"page {number} ends with a line below nothing" for number in _ruled(pages)),
        *(f"page {number} leaves alone {line!r}" for number, line in _left_alone(certificate, bodies)),
        *(f"page {number} parts a paragraph: {line!r}" for number, line in _widows(certificate, bodies)),
        *(f"page {number} parts a value from its unit: {line!r}" for number, line in _torn(bodies)),
        *(f"no page has {name!r} whole" for name in _broken(certificate, bodies)),
        *(f"page {number} parts the table {caption!r}" for number, caption in _parted(certificate, bodies)),
        *(
            f"page {number} has text outside its margins"
            for number, page in enumerate(pages, 1)
            if _spills(page)
        ),
    ]


def _lines(page: pypdfium2.PdfPage, bottom: float, top: float) -> list[str]:
    text = page.get_textpage().get_text_bounded(bottom=bottom, top=top)
    return [line for line in (" ".join(each.split()) for each in text.splitlines()) if line]


def _ruled(pages: list[pypdfium2.PdfPage]) -> Iterator[int]:
    """Yield pages with a rule at the end that stands apart from all else."""
    for number, page in enumerate(pages, 1):
        inked = np.flatnonzero(_ink(page, scale=1.0).any(axis=1))
        apart = np.diff(inked, prepend=inked[:1])
        if (apart[-2:] > _APART).any():
            yield number


def _ink(page: pypdfium2.PdfPage, *, scale: float) -> np.ndarray:
    """Return where a page has ink between its head and its foot."""
    ink = page.render(scale=scale, grayscale=True).to_numpy().squeeze() < 225
    return ink[int(_HEAD * scale) : int((page.get_height() - _FOOT) * scale)]


def _emptiness(
    certificate: Certificate, pages: list[pypdfium2.PdfPage], bodies: list[list[str]]
) -> Iterator[tuple[int, float]]:
    """Yield pages with little on them; the last has what is left of a section or a table that must part."""
    parted = [
        write_cell_text(each.columns[0].heading)
        for each in _blocks(certificate)
        if isinstance(each, Table) and not lay_out_table(each).is_whole
    ]
    may_be_short = (
        len(pages) == 1 or certificate.sections[-1].new_page or any(map(bodies[-1][0].startswith, parted))
    )
    begun = {f"{number} {each.title}" for number, each in enumerate(certificate.sections, 1) if each.new_page}
    for number, page in enumerate(pages, 1):
        body = _ink(page, scale=0.5).any(axis=1)
        fill = (np.flatnonzero(body).max(initial=-1) + 1) / len(body)
        is_last = number == len(pages)
        ends_part = bool(certificate.parts) and not is_last and bodies[number][0] in begun
        least = _LEAST_END if is_last or ends_part else _LEAST_FILL
        if fill < (0.0 if is_last and may_be_short else least):
            yield number, fill


def _missing_on_the_first(certificate: Certificate, first: list[str]) -> Iterator[str]:
    """Yield statements of the first page that do not stand on it whole."""
    if certificate.is_compact and not certificate.parts:
        there = _letters("".join(first))
        for block in certificate.cover:
            if isinstance(block, Paragraph) and _letters(block.text) not in there:
                yield block.text


def _left_alone(certificate: Certificate, bodies: list[list[str]]) -> Iterator[tuple[int, str]]:
    """Yield pages that end with a heading, begin with the last line of a part, or consist of notes alone."""
    notes = [each for each in _blocks(certificate) if isinstance(each, Paragraph | Notice)]
    headings = {f"{number} {section.title}" for number, section in enumerate(certificate.sections, 1)}
    headings |= {
        each.heading for each in _blocks(certificate) if isinstance(each, Notice | Facts) and each.heading
    }
    tables = [each for each in _blocks(certificate) if isinstance(each, Table)]
    headings |= {group.heading for each in tables for group in each.groups if group.heading}
    table = f"{certificate.page_words.table} "
    said = " ".join((*headings, *(text for each in notes for text in _texts(each))))
    for number, body in enumerate(bodies, 1):
        last = body[-1].lstrip("! ")
        if last in headings or last.startswith(table):
            yield number, last
        if (
            number > 1
            and len(body) > 1
            and body[0] in said
            and body[0] not in headings
            and body[1] in headings
        ):
            yield number, body[0]
    *_, end = bodies
    if len(bodies) > 1 and all(line.lstrip("! –") in said for line in end[:-1]):
        yield len(bodies), " / ".join(end)


def _texts(note: Paragraph | Notice) -> tuple[str, ...]:
    return (note.text,) if isinstance(note, Paragraph) else (note.heading, *note.items)


def _widows(certificate: Certificate, bodies: list[list[str]]) -> Iterator[tuple[int, str]]:
    """Yield pages that hold a single line of a paragraph that goes on."""
    texts = [each.text for each in _blocks(certificate) if isinstance(each, Paragraph)]
    for number, (before, after) in enumerate(pairwise(bodies), 1):
        for text in texts:
            if f"{before[-1]} {after[0]}" in text:
                if len(before) > 1 and f"{before[-2]} {before[-1]}" not in text:
                    yield number, before[-1]
                if len(after) > 1 and f"{after[0]} {after[1]}" not in text:
                    yield number + 1, after[0]


def _torn(bodies: list[list[str]]) -> Iterator[tuple[int, str]]:
    for number, body in enumerate(bodies, 1):
        for before, after in pairwise(body):
            if re.search(r"(?<!\S)−?\d[\d.,]*$", before) and re.match(r"(?:[µmn]?m|hPa|K|°C|%)(?!\w)", after):
                yield number, f"{before} / {after}"


def _broken(certificate: Certificate, bodies: list[list[str]]) -> Iterator[str]:
    """Yield words of names of facts that are wider than their place."""
    words = {word for body in bodies for line in body for word in line.split()}
    names = [name for each in _blocks(certificate) if isinstance(each, Facts) for name, _ in each.pairs]
    yield from (word for name in names for word in name.split() if word not in words)


def _parted(certificate: Certificate, bodies: list[list[str]]) -> Iterator[tuple[int, str]]:
    """Yield tables of which a row stands elsewhere than their caption: of long ones, one of the first two."""
    numbered_blocks = [each for each in _blocks(certificate) if isinstance(each, Table | Formulas)]
    for place, table in enumerate(numbered_blocks, 1):
        if isinstance(table, Formulas):
            continue
        begins = f"{certificate.page_words.table} {place} {table.caption[:20]}"
        numbered = [at for at, body in enumerate(bodies) if any(each.startswith(begins) for each in body)]
        if not numbered:
            continue
        rows = [row for group in table.groups for row in group.rows]
        words = _letters("".join(bodies[numbered[0]]))
        cells = [
            write_cell_text(cell)
            for row in (rows if lay_out_table(table).is_whole else rows[:2])
            for cell in row
            if not isinstance(cell, Symbol)
        ]
        if not all(_letters(cell) in words for cell in cells if cell.isascii()):
            yield numbered[0] + 1, table.caption


def _letters(text: str) -> str:
    """Return a text without blanks and hyphens: PDFium takes one at the end of a line for hyphenation."""
    return "".join(character for character in text if character.isalnum())


def _spills(page: pypdfium2.PdfPage) -> bool:
    text = page.get_textpage()
    edges = [text.get_rect(each) for each in range(text.count_rects())]
    return any(left < _SIDE or right > page.get_width() - _SIDE for left, _, right, _ in edges)


def _blocks(certificate: Certificate) -> Iterator[object]:
    yield from certificate.cover
    for section in certificate.sections:
        yield from section.blocks
