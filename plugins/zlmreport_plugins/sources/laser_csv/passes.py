"""Guesses directions and runs of an unknown table: by names, by order, or by tables one below the other."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from copy import deepcopy
from statistics import median
from typing import Any

from zlmreport.plugin import Approach
from zlmreport_plugins.sources.laser_csv import questions
from zlmreport_plugins.sources.laser_csv.drafts import Draft
from zlmreport_plugins.sources.laser_csv.layouts import find_senses
from zlmreport_plugins.sources.laser_csv.meanings import read_number
from zlmreport_plugins.sources.laser_csv.options import names_direction, read_direction, run_and_direction
from zlmreport_plugins.sources.laser_csv.tables import FoundTable


def tell_passes(draft: Draft) -> Iterator[Draft]:
    """Yield the draft with what tells directions and runs; where it is open, in the ways that may be."""
    table = draft.table
    directions, runs = draft.find_column("direction"), draft.find_column("run")
    targets = [value for value in table.list_numbers(draft.find_column("target") or 0) if value is not None]
    if directions is not None and _are_directions(table.list_cells(directions)):
        taken = [
            (target, read_direction(cell))
            for target, cell in zip(targets, table.list_cells(directions), strict=False)
            if cell
        ]
        if runs is None and len(set(taken)) < len(taken):
            draft.keys["runs"] = "counted"
            draft.asks.append(questions.RUNS_ASKED)
        yield draft
        return
    if directions is not None:
        draft.ignored.append(draft.name_column(directions))
        draft.columns.pop("direction", None)
    taken_in = find_senses(targets)
    goes_back = _find_way_back(targets)
    if goes_back or all(sense > 0 for sense in taken_in) or _is_one_pass_each(draft, taken_in):
        draft.keys["direction"] = goes_back or "+"
        draft.asks.append(questions.DIRECTION_ASKED)
        if runs is None and len(set(targets)) < len(targets):
            draft.keys["runs"] = "counted"
            draft.asks.append(questions.RUNS_ASKED)
    else:
        draft.keys["direction"] = "by-order"
        draft.asks.append(questions.ORDER_ASKED)
        numbered = table.list_cells(runs) if runs is not None else []
        if runs is not None and _are_passes(numbered, taken_in):
            draft.ignored.append(draft.name_column(runs))
            draft.columns.pop("run", None)
            runs = None
        if runs is None:
            draft.keys["runs"] = "counted"
    yield draft


def _are_directions(cells: Sequence[str]) -> bool:
    try:
        return bool([read_direction(cell) for cell in cells if cell])
    except ValueError:
        return False


def _find_way_back(targets: Sequence[float]) -> str:
    """Return the sign in which all targets were approached, where the axis goes back in one step."""
    first, last = min(targets), max(targets)
    for sign, begin, end in (("+", first, last), ("-", last, first)):
        back = [
            (before, at)
            for before, at in itertools.pairwise(targets)
            if (at < before) == (sign == "+") and at != before
        ]
        if back and all(step == (end, begin) for step in back) and len(set(targets)) > 2:
            return sign
    return ""


def _is_one_pass_each(draft: Draft, taken_in: Sequence[int]) -> bool:
    """Return whether every run goes over the targets once, upwards: the axis went back between them."""
    runs = draft.find_column("run")
    if runs is None:
        return False
    cells = draft.table.list_cells(runs)
    pairs = list(zip(cells, taken_in, strict=False))
    inside = [sense for (cell, sense), (before, _) in zip(pairs[1:], pairs, strict=False) if cell == before]
    return bool(inside) and all(sense > 0 for sense in inside)


def _are_passes(runs: Sequence[str], taken_in: Sequence[int]) -> bool:
    """Return whether runs number the passes: each goes in one direction, and there are both."""
    of_run: dict[str, list[int]] = {}
    for run, sense in zip(runs, taken_in, strict=False):
        of_run.setdefault(run, []).append(sense)
    main = [round(median(each)) for each in of_run.values()]
    return all(
        sum(sense != way for sense in each) <= 1 for each, way in zip(of_run.values(), main, strict=True)
    )


def draft_of_parts(found: Sequence[FoundTable], drafts: Sequence[Draft]) -> Iterator[Draft]:
    """Yield how a file is read that has a table of each direction: a sheet each, or below one another.

    `drafts`: How the first table found is read alone.
    """
    if not drafts or "direction" in found[0].meanings:
        return
    best = found[0]
    same = [each for each in found if each.header.cells == best.header.cells and each.layout.header_rows]
    sheets = {each.found.keys["sheet"]: each for each in same if "sheet" in each.found.keys}
    parts = []
    if len(sheets) > 1:
        for sheet, table in sheets.items():
            part = {"sheet": sheet} | ({"skip_rows": table.layout.skipped} if table.layout.skipped else {})
            parts.append((part, _find_direction_in(sheet)))
    else:
        parts = list(_list_stacked(best))
    if len(parts) < 2 or {approach for _, approach in parts} != {*Approach}:
        return
    draft = deepcopy(drafts[0])
    if any(run_and_direction(each) for each in draft.columns):
        return  # the names of the columns tell directions already
    for key in ("sheet", "skip_rows", "ends_before", "lines", "direction"):
        draft.keys.pop(key, None)
    draft.keys["parts"] = [{**part, "direction": approach.sign} for part, approach in parts if approach]
    draft.asks = [
        each for each in draft.asks if each not in {questions.DIRECTION_ASKED, questions.ORDER_ASKED}
    ]
    yield draft


def _list_stacked(table: FoundTable) -> Iterator[tuple[dict[str, Any], Approach | None]]:
    """Yield the tables with the same header that stand below each other, each with the direction above it."""
    if table.layout.is_transposed or table.layout.header_rows != 1:
        return
    numbered = dict(table.found.lines)
    at = list(table.meanings).index("target")
    header, last, before = table.header, table.rows[-1].line, table.layout.skipped
    rows = iter(table.below)
    while True:
        above = " ".join(line for number_, line in numbered.items() if before - 3 < number_ < header.line)
        yield {"lines": [header.line, last]}, _find_direction_in(above)
        again = next((row for row in rows if row.cells == table.header.cells), None)
        if again is None:
            return
        header, before = again, max(last, again.line - 3)
        for row in rows:
            if at < len(row.cells) and read_number(row.cells[at], table.notation) is not None:
                last = row.line
            elif last > header.line:
                break


def _find_direction_in(text: str) -> Approach | None:
    """Return the direction that a text names, if it names one only."""
    words = re.findall(r"[^\W\d_]+|[↑↓→←]", text.casefold())
    named = {read_direction(word) for word in words if names_direction(word)}
    return named.pop() if len(named) == 1 else None
