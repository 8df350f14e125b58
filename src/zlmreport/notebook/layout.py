"""Sections of ``document/subjects/`` shown in a notebook: their blocks as HTML, graphs left out."""

from __future__ import annotations

import html
from collections.abc import Iterable, Iterator

from zlmreport.document.blocks import (
    Block,
    ColumnKind,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    Section,
    Table,
    write_cell_text,
)
from zlmreport.language.formatting import write_plain
from zlmreport.notebook.frames import as_html


def sections_html(sections: Iterable[Section]) -> str:
    """Return sections under their titles: texts escaped, graphs left out."""
    return "".join(
        f"<h4>{html.escape(each.title)}</h4>"
        + "".join(_write_html(block, each.title) for block in each.blocks)
        for each in sections
    )


def _write_html(block: Block, title: str) -> str:
    match block:
        case Paragraph(text):
            return f"<p>{html.escape(text)}</p>"
        case Notice(heading, items):
            above = f"<p>{html.escape(heading)}</p>" if heading != title else ""
            return f"{above}<ul>{''.join(f'<li>{html.escape(item)}</li>' for item in items)}</ul>"
        case Facts(pairs):
            return as_html(tuple(name for name, _ in pairs), [tuple(value for _, value in pairs)])
        case Table():
            return _write_table(block)
        case Formulas(rows=rows):
            return as_html(
                ("", "", ""),
                [(write_plain(a.notation), write_plain(b.notation), name) for a, b, name in rows],
            )
        case Graph():
            return ""


def _write_table(table: Table) -> str:
    columns = [column for column in table.columns if column.kind is not ColumnKind.BARS]
    shown = table.without(*(column.key for column in table.columns if column not in columns))
    head = [" ".join(filter(None, (write_cell_text(column.heading), column.unit))) for column in columns]
    return as_html(head, _rows(shown))


def _rows(table: Table) -> Iterator[list[str]]:
    """Yield the rows, the heading of a group in a row of its own."""
    for group in table.groups:
        if group.heading:
            yield [group.heading, *[""] * (len(table.columns) - 1)]
        yield from ([write_cell_text(cell) for cell in row] for row in group.rows)
