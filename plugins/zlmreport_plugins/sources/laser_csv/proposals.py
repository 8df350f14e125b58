"""Proposes the keys by which an unknown table may be read, and asks what only its author can say."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set as AbstractSet
from contextlib import suppress
from pathlib import Path
from statistics import median
from typing import Any

from zlmreport.plugin import Approach, InputError, Place, listed
from zlmreport.plugin.source import SourceProposal
from zlmreport.plugin.table import EnclosureError, TextRow, folded, moment, parted_line
from zlmreport_plugins.logged_columns import SOME_TEMPERATURE
from zlmreport_plugins.sources.laser_csv import questions
from zlmreport_plugins.sources.laser_csv.drafts import (
    Draft,
    is_unit_known,
    name_unit,
    note_notation,
    place_table,
)
from zlmreport_plugins.sources.laser_csv.layouts import read_heading
from zlmreport_plugins.sources.laser_csv.meanings import (
    DIFFERENCES,
    READING,
    Notation,
    are_positions,
    find_axis_in,
    find_lettered,
    find_meaning,
    find_reading_of,
    read_number,
)
from zlmreport_plugins.sources.laser_csv.options import COLUMN_NAMES, run_and_direction
from zlmreport_plugins.sources.laser_csv.passes import draft_of_parts, tell_passes
from zlmreport_plugins.sources.laser_csv.tables import FoundTable, find_tables, is_summary, list_texts

#: Axes that turn, by their letters, and a whole turn of them in degrees.
_TURNING, _WHOLE_TURN = frozenset("ABC"), 360.0
#: What columns of readings are, and words by which a name says that its values are averages.
_OF_READINGS = frozenset({"deviation", "position", READING})
_AVERAGE = re.compile(
    r"(?<![^\W_])(?:avg|average|mean|mittel|mittelwert|moyenne|moyen|media|promedio)(?![^\W_])|平均|均值",
    re.IGNORECASE,
)
#: How many times as large as any other, and as is usual, a deviation is off that is not actual − target.
_DISAGREES = 3.0
#: Lines of a table without a head that may be comments above its names.
_COMMENTS = 3
#: How a column is called that names the axis, folded.
_OF_AXES = frozenset({"axis", "achse", "axe", "asse", "eje", "轴", "軸"})


def propose(file: Path) -> Iterator[SourceProposal]:
    """Yield the keys by which a file may be read, the likeliest first."""
    texts = list(list_texts(file))
    found = [table for text in texts for table in find_tables(text)]
    found.sort(key=lambda table: table.score, reverse=True)
    axis = _find_axis(file, found)
    for table in found[:1]:
        _refuse_several_axes(table, file)
        _refuse_axes_side_by_side(table, file)
    drafts = [each for table in found for each in _list_drafts(table)]
    for draft in (*draft_of_parts(found, drafts[:1]), *drafts):
        _ask_for_sheet(draft, found)
        _ask_for_rows_outside(draft)
        _ask_for_kind(draft, axis)
        yield SourceProposal(_order_keys(draft), tuple(draft.asks), axis)
    for text in () if drafts else texts:
        if text.keys.get("encoding", "").startswith("utf"):
            yield SourceProposal(dict(text.keys))  # what it lacks is told then, and not its encoding


def _find_axis(file: Path, found: Sequence[FoundTable]) -> str:
    """Return the letter of the axis that the file, its name or what stands above the table names."""
    above = [
        line for table in found[:1] for line in table.found.text.lines[: table.layout.skipped + _COMMENTS]
    ]
    for text in (file.stem, *(table.found.keys.get("sheet", "") for table in found[:1]), *above):
        if letter := find_axis_in(text):
            return letter
    return ""


def _refuse_several_axes(table: FoundTable, file: Path) -> None:
    """Refuse a table with a column that names the axis of each reading, and names several."""
    for index, name in enumerate(table.header.cells):
        axes = dict.fromkeys(cell for cell in table.list_cells(index) if cell)
        if folded(name) in _OF_AXES and len(axes) > 1:
            raise InputError.at(
                Place(str(file), table.header.line),
                f"holds readings of several axes, as its column {name!r} says ({listed(axes)}); write a "
                "file of each axis, for a test is of one",
            )


def _refuse_axes_side_by_side(table: FoundTable, file: Path) -> None:
    """Refuse a table with columns of the same quantity of several axes: ``Error X`` and ``Error Y``."""
    of_quantity: dict[str, dict[str, str]] = {}
    for name in table.header.cells:
        words = re.findall(r"[^\W_]+", read_heading(name).name.casefold())
        letters = [word for word in words if re.fullmatch("[xyzabcuvw]", word)]
        others = " ".join(word for word in words if word not in letters)
        if len(letters) == 1 and others:
            of_quantity.setdefault(others, {}).setdefault(letters[0].upper(), name)
    for named in of_quantity.values():
        if len(named) > 1:
            raise InputError.at(
                Place(str(file), table.header.line),
                f"holds readings of several axes side by side ({listed(map(repr, named.values()))}); a test "
                "is of one: name its columns in the job, as in 'columns: {target: …, deviation: …}', and "
                "those of the others under 'ignore'",
            )


def _list_drafts(table: FoundTable) -> Iterator[Draft]:
    draft = Draft(table)
    _ask_for_averages(draft)
    place_table(draft)
    note_notation(draft)
    if table.is_wide:
        _draft_wide(draft)
        yield draft
        return
    _draft_value(draft)
    _draft_other_columns(draft)
    _name_unnamed(draft)
    yield from tell_passes(draft)


def _ask_for_averages(draft: Draft) -> None:
    """Ask whether values are averages, where the name of their column says so, or the line above a table."""
    table = draft.table
    above = [line for number, line in table.found.lines if number <= table.layout.skipped]
    names = [
        name for name, what in zip(table.header.cells, table.meanings, strict=True) if what in _OF_READINGS
    ] or ["".join(above[-1:])]
    named = next((name for name in names if _AVERAGE.search(name)), None)
    if named and (table.layout.header_rows == 0 or named in table.header.cells):
        draft.asks.append(questions.AVERAGES_ASKED.format(name=repr(" ".join(named.split()))))


def _draft_wide(draft: Draft) -> None:
    """Say which columns are readings, of what, and leave out the others."""
    table, keys = draft.table, draft.keys
    keys["layout"] = "wide"
    target = draft.find_column("target") or 0
    readings = [index for index, each in enumerate(table.meanings) if each == READING]
    lettered = find_lettered(table.header.cells)
    told = [
        lettered.get(index) or find_reading_of(draft.name_column(index)) or (1, None) for index in readings
    ]
    if lettered:
        draft.asks.append(_ask_for_initials(draft, lettered))
    second = _find_second_targets(draft, target)
    if second is not None and all(approach is None for _, approach in told):
        told = [
            (run, Approach.NEGATIVE if index > second else Approach.POSITIVE)
            for index, (run, _) in zip(readings, told, strict=True)
        ]
        draft.asks.append(questions.SECOND_ASKED)
    elif all(approach is None for _, approach in told):
        keys["direction"] = "+"
        draft.asks.append(questions.DIRECTION_ASKED)
    _name_target(draft, target)
    if len(set(told)) < len(told) or not draft.name_column(target) or _has_equal_names(table):
        _name_all(draft, target, readings, told)
    else:
        for index, (run, approach) in zip(readings, told, strict=True):
            if run_and_direction(read_heading(draft.name_column(index)).name) != (run, approach):
                sign = (approach or Approach.POSITIVE).sign
                draft.columns[f"{run}{sign}"] = read_heading(draft.name_column(index)).name
        draft.ignored += [
            name
            for index, name in enumerate(table.header.cells)
            if name and index != target and index not in readings
        ]
        _ask_for_other_direction(draft, readings, {approach for _, approach in told})
    first, targets = readings[0], [each for each in table.list_numbers(target) if each is not None]
    if len(set(targets)) < len(targets):
        draft.count_runs()
    if are_positions(table.list_numbers(target), table.list_numbers(first)):
        keys["values"] = "position"
        name_unit("position", draft, target, first)
    else:
        draft.asks.append(questions.SIGN_ASKED)
        name_unit("deviation", draft, target, *readings)


def _ask_for_initials(draft: Draft, lettered: Mapping[int, tuple[int, Approach]]) -> str:
    """Ask whether initials are of the directions that they seem to be."""
    names = {approach: draft.name_column(index) for index, (_, approach) in reversed([*lettered.items()])}
    return questions.INITIALS_ASKED.format(
        up=repr(names[Approach.POSITIVE]), down=repr(names[Approach.NEGATIVE])
    )


def _ask_for_other_direction(
    draft: Draft, readings: Sequence[int], approaches: AbstractSet[Approach | None]
) -> None:
    """Ask whether columns that are not read, as many and in the same unit, are the readings moving back."""
    units = {read_heading(draft.name_column(index)).bracket for index in readings}
    others = [name for name in draft.ignored if read_heading(name).bracket in units - {None}]
    if approaches == {Approach.POSITIVE} and len(others) == len(readings):
        first = read_heading(others[0]).name
        draft.asks.append(
            questions.OTHER_DIRECTION_ASKED.format(names=listed(map(repr, others)), first=first)
        )


def _find_second_targets(draft: Draft, target: int) -> int | None:
    """Return the place of a second column of the same targets: a table stands beside the first one.

    Raises `InputError` if it has them in another order: a row is then none of one target.
    """
    table, name = draft.table, folded(draft.name_column(target))
    same = (index for index, each in enumerate(table.header.cells) if index > target and folded(each) == name)
    second = next(same, None) if name else None
    if second is not None and table.list_numbers(second) != table.list_numbers(target):
        raise InputError.at(
            Place(table.found.text.name, table.header.line),
            "two tables stand side by side, and a row holds one target in the one and another in the other; "
            "write them one below the other, each with its header",
        )
    return second


def _has_equal_names(table: FoundTable) -> bool:
    names = [folded(name) for name in table.header.cells if name]
    return len(set(names)) < len(names)


def _name_target(draft: Draft, target: int) -> None:
    name = read_heading(draft.name_column(target)).name
    if name and folded(name) != "target":
        draft.columns["target"] = name
    is_unit_known("target", draft, target)


def _name_all(
    draft: Draft, target: int, readings: Sequence[int], told: Sequence[tuple[int, Approach | None]]
) -> None:
    """Give every column a name, where those of the file are missing or stand several times."""
    seen: dict[Approach, int] = {}
    names: dict[int, str] = {target: "target"}
    are_counted = len(set(told)) < len(told)
    for index, (run, approach) in zip(readings, told, strict=True):
        sense = approach or Approach.POSITIVE
        seen[sense] = seen.get(sense, 0) + 1
        names[index] = f"{seen[sense] if are_counted else run}{sense.sign}"
    others = {
        index: f"column {index + 1}"
        for index, cells in enumerate(draft.table.header.cells)
        if index not in names and (cells or any(draft.table.list_cells(index)))
    }
    last = max({**names, **others})
    draft.keys["header"] = [names.get(index) or others.get(index, "") for index in range(last + 1)]
    draft.keys["skip_rows"] = draft.table.header.line
    draft.keys.pop("header_rows", None)
    draft.keys.pop("direction", None)
    draft.columns.clear()
    draft.ignored += others.values()


def _draft_value(draft: Draft) -> None:
    """Say what a long table holds, and where: deviations, or actual positions."""
    target = draft.find_column("target") or 0
    deviation, position = draft.find_column("deviation"), draft.find_column("position")
    if not draft.table.layout.header_rows and deviation is None and position is None:
        beside = 1
        is_position = are_positions(draft.table.list_numbers(target), draft.table.list_numbers(beside))
        names = list(draft.table.header.cells)
        if not any(names):
            names = ["target", "position" if is_position else "deviation"]
            deviation, position = (None, beside) if is_position else (beside, None)
            draft.keys["header"] = names
    elif not draft.table.layout.header_rows:
        draft.keys["header"] = list(draft.table.header.cells)
    if not draft.keys.get("header") or any(draft.table.header.cells):
        _name_target(draft, target)
    if deviation is not None and position is not None:
        draft.ignored.append(draft.name_column(position))
        _compare(draft, target, deviation, position)
    elif position is not None:
        name_unit("position", draft, target, position)
    if deviation is not None:
        sign = DIFFERENCES.get(folded(read_heading(draft.name_column(deviation)).name))
        if sign == "nominal-actual" and position is None:
            draft.keys["sign"] = sign
        if sign is None and position is None:
            draft.asks.append(questions.SIGN_ASKED)
        name_unit("deviation", draft, target, deviation)


def _compare(draft: Draft, target: int, deviation: int, position: int) -> None:
    """Say the sign of deviations beside which the actual positions stand, if these tell it."""
    table = draft.table
    products = [
        (actual - at) * value
        for at, value, actual in zip(
            table.list_numbers(target),
            table.list_numbers(deviation),
            table.list_numbers(position),
            strict=True,
        )
        if at is not None and value is not None and actual is not None
    ]
    _ask_where_they_disagree(draft, target, deviation, position)
    negative, positive = sum(each < 0 for each in products), sum(each > 0 for each in products)
    if negative > 3 * positive:
        draft.keys["sign"] = "nominal-actual"
    elif positive <= 3 * negative:
        draft.asks.append(questions.SIGN_ASKED)


def _ask_where_they_disagree(draft: Draft, target: int, deviation: int, position: int) -> None:
    """Ask about the row in which a deviation is not the difference that it is in all others."""
    table = draft.table
    columns = (table.list_numbers(index) for index in (target, position, deviation))
    rows = [
        (row.line, actual - at, value)
        for row, at, actual, value in zip(table.rows, *columns, strict=True)
        if at is not None and actual is not None and value is not None
    ]
    ratios = [value / difference for _, difference, value in rows if difference]
    if not ratios:
        return
    ratio = median(ratios)
    left = [abs(value - ratio * difference) for _, difference, value in rows]
    worst = max(range(len(rows)), key=left.__getitem__)
    others = max((each for index, each in enumerate(left) if index != worst), default=0.0)
    if left[worst] > _DISAGREES * max(others, median(abs(value) for *_, value in rows)):
        draft.asks.append(questions.DISAGREE_ASKED.format(line=rows[worst][0]))


def _draft_other_columns(draft: Draft) -> None:
    """Name the columns that go by other names, and leave out those that hold words or count the rows."""
    table = draft.table
    for index, (name, what) in enumerate(zip(table.header.cells, table.meanings, strict=True)):
        if not name or name in draft.ignored:
            continue
        cells = [cell for cell in table.list_cells(index) if cell]
        if what == "time" and not _is_time(cells, table.notation):
            draft.ignored.append(name)
            draft.asks.append(questions.TIME_ASKED.format(name=repr(name), example=repr(cells[0])))
        elif what is None and (
            any(read_number(cell, table.notation) is None for cell in cells)
            or find_meaning(name) is not None
            or not cells
        ):
            draft.ignored.append(name)
        elif what is None and folded(read_heading(name).name) in SOME_TEMPERATURE:
            draft.asks.append(questions.TEMPERATURE_ASKED.format(name=read_heading(name).name))
        elif what is not None and what not in {"target", READING}:
            plain = read_heading(name).name
            if folded(plain) != what:
                draft.columns[what] = plain
            is_unit_known(what, draft, index)


def _name_unnamed(draft: Draft) -> None:
    """Give a column that has cells and no name one, and leave it out: the index of a data frame."""
    table = draft.table
    names = list(table.header.cells)
    unnamed = [index for index, name in enumerate(names) if not name and any(table.list_cells(index))]
    if unnamed and table.layout.header_rows == 1 and not table.layout.is_transposed:
        for index in unnamed:
            names[index] = f"column {index + 1}"
        draft.keys |= {"skip_rows": table.header.line, "header": names}
        draft.ignored += [names[index] for index in unnamed]


def _is_time(cells: Sequence[str], notation: Notation) -> bool:
    return all(read_number(cell, notation) is not None or moment(cell) is not None for cell in cells[:1])


def _ask_for_kind(draft: Draft, axis: str) -> None:
    targets = [
        each for each in draft.table.list_numbers(draft.find_column("target") or 0) if each is not None
    ]
    is_turn = max(targets) - min(targets) == _WHOLE_TURN
    if (
        is_turn
        and axis not in _TURNING
        and not is_unit_known("target", draft, draft.find_column("target") or 0)
    ):
        draft.asks.append(questions.TURN_ASKED)


def _ask_for_sheet(draft: Draft, found: Sequence[FoundTable]) -> None:
    sheet = draft.keys.get("sheet")
    others = dict.fromkeys(
        repr(each.found.keys.get("sheet")) for each in found if each.found.keys.get("sheet") != sheet
    )
    if sheet and others:
        hold = "holds" if len(others) == 1 else "hold"
        draft.asks.append(questions.SHEETS_ASKED.format(sheet=repr(sheet), others=listed(others), hold=hold))


def _ask_for_rows_outside(draft: Draft) -> None:
    """Ask whether rows of numbers outside the table belong to the test, where they are no part of it."""
    table = draft.table
    if "parts" in draft.keys or table.layout.is_transposed:
        return
    below = _list_lines_of_numbers((row for row in table.below if not is_summary(row.cells)), table.notation)
    if len(below) > 1:
        draft.asks.append(questions.BELOW_ASKED.format(count=len(below), first=below[0]))
    above = _list_lines_of_numbers(_list_rows_above(table), table.notation)
    if len(above) > 1:
        draft.asks.append(questions.ABOVE_ASKED.format(count=len(above), last=above[-1]))


def _list_lines_of_numbers(rows: Iterable[TextRow], notation: Notation) -> list[int]:
    return [row.line for row in rows if sum(_is_number(cell, notation) for cell in row.cells) > 1]


def _list_rows_above(table: FoundTable) -> Iterator[TextRow]:
    """Yield the rows of a text above the header of its table."""
    for number, line in table.found.lines:
        if number <= table.layout.skipped and table.layout.header_rows:
            with suppress(EnclosureError):
                yield parted_line(number, line, table.layout.delimiter)


def _is_number(cell: str, notation: Notation) -> bool:
    return read_number(cell, notation) is not None


def _order_keys(draft: Draft) -> dict[str, Any]:
    """Return the keys in the order in which people read them."""
    keys = draft.keys
    if draft.columns:
        keys["columns"] = {
            name: draft.columns[name] for name in (*COLUMN_NAMES, *draft.columns) if name in draft.columns
        }
    if draft.units:
        keys["units"] = draft.units
    if draft.ignored:
        keys["ignore"] = draft.ignored
    return keys
