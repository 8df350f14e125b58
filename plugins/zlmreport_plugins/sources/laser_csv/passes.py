"""Guesses directions and runs of an unknown table: by names, by order, or by tables one below the other."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from statistics import median
from typing import Any

from zlmreport.plugin import Approach
from zlmreport_plugins.sources.laser_csv import questions
from zlmreport_plugins.sources.laser_csv.drafts import Draft
from zlmreport_plugins.sources.laser_csv.layouts import find_senses
from zlmreport_plugins.sources.laser_csv.meanings import find_axis_in, read_number
from zlmreport_plugins.sources.laser_csv.options import names_direction, read_direction, run_and_direction
from zlmreport_plugins.sources.laser_csv.tables import FoundTable


def tell_passes(draft: Draft) -> Iterator[Draft]:
    """Yield the draft with what tells directions and runs; where it is open, in the ways that may be."""
    table = draft.table
    directions, runs = draft.find_column("direction"), draft.find_column("run")
    targets = [value for value in table.list_numbers(draft.find_column("target") or 0) if value is not None]
    if directions is not None and _are_directions(table.list_cells(directions)):
        _tell_runs(draft, runs, directions, targets)
        yield draft
        return
    if directions is not None:
        draft.ignored.append(draft.name_column(directions))
        draft.columns.pop("direction", None)
    if runs is not None and _number_no_cycles(draft, runs):
        _ignore_runs(draft, runs)
        runs = None
    taken_in = find_senses(targets)
    goes_back = _find_way_back(targets)
    if goes_back or all(sense > 0 for sense in taken_in) or _is_one_pass_each(draft, taken_in):
        draft.keys["direction"] = goes_back or "+"
        draft.asks.append(questions.DIRECTION_ASKED)
        if runs is None and len(set(targets)) < len(targets):
            draft.count_runs()
    else:
        draft.keys["direction"] = "by-order"
        draft.asks.append(questions.ORDER_ASKED)
        numbered = table.list_cells(runs) if runs is not None else []
        if runs is not None and _are_passes(numbered, taken_in):
            _ignore_runs(draft, runs)
            runs = None
        if runs is None:
            draft.keys["runs"] = "counted"
    yield draft


def _tell_runs(draft: Draft, runs: int | None, directions: int, targets: Sequence[float]) -> None:
    """Say what tells the runs of a table whose directions are told by a column."""
    taken = [
        (target, _read_direction_or_none(cell))
        for target, cell in zip(targets, draft.table.list_cells(directions), strict=False)
        if cell
    ]
    if runs is not None and len(set(taken)) < len(taken) and len({*draft.table.list_cells(runs)}) == 1:
        _ignore_runs(draft, runs)  # it numbers the test
        runs = None
    elif runs is not None and _number_no_cycles(draft, runs, draft.table.list_cells(directions)):
        _ignore_runs(draft, runs)
        runs = None
    if runs is None and len(set(taken)) < len(taken):
        draft.count_runs()


def _number_no_cycles(draft: Draft, runs: int, directions: Sequence[str] = ()) -> bool:
    """Return whether a column of runs does not count them from 1, or counts the passes in both directions."""
    cells = draft.table.list_cells(runs)
    if any((draft.table.list_numbers(runs)[index] or 0) < 1 for index, cell in enumerate(cells) if cell):
        return True
    ways = [(cell, _read_direction_or_none(way)) for cell, way in zip(cells, directions, strict=False)]
    return len({way for _, way in ways}) > 1 and len({*ways}) == len({cell for cell, _ in ways}) > 1


def _ignore_runs(draft: Draft, runs: int) -> None:
    draft.ignored.append(draft.name_column(runs))
    draft.columns.pop("run", None)


def _are_directions(cells: Sequence[str]) -> bool:
    """Return whether most cells name a direction; one that names none is then told at its place."""
    named = [cell for cell in cells if cell]
    return 2 * sum(_read_direction_or_none(cell) is not None for cell in named) > len(named)


def _read_direction_or_none(cell: str) -> Approach | None:
    try:
        return read_direction(cell)
    except ValueError:
        return None


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
    """Yield how a file is read that has a table of each direction or run: a sheet each, or below another.

    `drafts`: How the first table found is read alone.
    """
    if not drafts:
        return
    best, alone = found[0], drafts[0]
    same = [each for each in found if each.header.cells == best.header.cells and each.layout.header_rows]
    sheets = {each.found.keys["sheet"]: each for each in same if "sheet" in each.found.keys}
    first = min((each for each in same if _are_laid_out_alike(each, best)), key=_find_line, default=best)
    tables = list(_list_sheets(sheets) if len(sheets) > 1 else _list_stacked(first))
    if len(tables) < 2 or len({each.axis for each in tables} - {""}) > 1:
        return
    tells_direction = "direction" in best.meanings or any(map(run_and_direction, alone.columns))
    if {each.approach for each in tables} == {*Approach} and not tells_direction:
        parts = [{**each.part, "direction": each.approach.sign} for each in tables if each.approach]
        draft = _join_parts(
            alone, parts, questions.DIRECTION_ASKED, questions.ORDER_ASKED, without="direction"
        )
        if len(parts) > len(Approach) and _are_runs_of_one(tables, alone):
            _ask_for_runs(draft)
        yield draft
    elif len(sheets) < 2 and _are_runs_of_one(tables, alone) and "header" not in alone.keys:
        draft = _join_parts(alone, [each.part for each in tables])
        if questions.DIRECTION_ASKED in draft.asks and len({_goes_up(each.targets) for each in tables}) > 1:
            draft.keys["direction"] = "by-order"
            draft.asks[draft.asks.index(questions.DIRECTION_ASKED)] = questions.ORDER_ASKED
        _ask_for_runs(draft)
        yield draft


def _goes_up(targets: Sequence[float]) -> bool:
    return targets[0] < targets[-1]


def _ask_for_runs(draft: Draft) -> None:
    """Count the runs of tables below each other, if no column does, and ask whether they are of one test."""
    if draft.find_column("run") is None:
        draft.keys["runs"] = "counted"
    draft.asks = [each for each in draft.asks if each != questions.RUNS_ASKED]
    draft.asks.append(questions.PARTS_ASKED.format(count=len(draft.keys["parts"])))


def _are_laid_out_alike(one: FoundTable, other: FoundTable) -> bool:
    """Return whether tables of one text differ by their place alone."""
    return replace(one.layout, skipped=other.layout.skipped) == other.layout


def _find_line(table: FoundTable) -> int:
    return table.header.line


def _are_runs_of_one(tables: Sequence[_Part], alone: Draft) -> bool:
    """Return whether tables have the same targets, or a column numbers their runs."""
    return len({frozenset(each.targets) for each in tables}) == 1 or alone.find_column("run") is not None


def _join_parts(alone: Draft, parts: list[dict[str, Any]], *answered: str, without: str = "") -> Draft:
    """Return how several tables are read, each as the first alone, without the answered questions."""
    draft = deepcopy(alone)
    for key in ("sheet", "skip_rows", "ends_before", "lines", without):
        draft.keys.pop(key, None)
    draft.keys["parts"] = parts
    draft.asks = [each for each in draft.asks if each not in answered]
    return draft


@dataclass(frozen=True, slots=True)
class _Part:
    """One of several tables of a file with the same header."""

    part: dict[str, Any]  #: The keys of its place.
    approach: Approach | None  #: The direction that its sheet or a line above it names.
    targets: tuple[float, ...] = ()  #: Of its rows, as the file has them.
    axis: str = ""  #: The letter of the axis that its sheet or a line above it names.


def _list_sheets(sheets: Mapping[str, FoundTable]) -> Iterator[_Part]:
    """Yield the table of each sheet, with the direction that the sheet is called by."""
    for sheet, table in sheets.items():
        skipped = {"skip_rows": table.layout.skipped} if table.layout.skipped else {}
        yield _Part({"sheet": sheet, **skipped}, _find_direction_in(sheet), axis=find_axis_in(sheet))


def _list_stacked(table: FoundTable) -> Iterator[_Part]:
    """Yield the tables with the same header that stand below each other, each with the direction above it."""
    if table.layout.is_transposed or table.layout.header_rows != 1:
        return
    numbered = dict(table.found.lines)
    at = list(table.meanings).index("target")
    header, before, below = table.header, table.layout.skipped, [*table.below]
    targets = {
        row.line: target
        for row, target in zip(table.rows, table.list_numbers(at), strict=True)
        if target is not None
    }
    while targets:
        above = " ".join(line for number_, line in numbered.items() if before - 3 < number_ < header.line)
        last = max(targets)
        of_part = tuple(targets.values())
        yield _Part({"lines": [header.line, last]}, _find_direction_in(above), of_part, find_axis_in(above))
        starts = [index for index, row in enumerate(below) if row.cells == table.header.cells]
        if not starts:
            return
        header, below = below[starts[0]], below[starts[0] + 1 :]
        before = max(last, header.line - 3)
        targets = {}
        for row in below:
            target = read_number(row.cells[at], table.notation) if at < len(row.cells) else None
            if target is not None:
                targets[row.line] = target
            elif targets:
                break


def _find_direction_in(text: str) -> Approach | None:
    """Return the direction that a text names, if it names one only."""
    words = re.findall(r"[^\W\d_]+|[↑↓→←]", text.casefold())
    named = {read_direction(word) for word in words if names_direction(word)}
    return named.pop() if len(named) == 1 else None
