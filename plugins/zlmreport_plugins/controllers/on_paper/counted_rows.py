"""Tables of controls that count rows from the reference point of the axis, and add up what each section has.

The value of a section is by how much the correction changes over it; at the reference point it is zero. Where
that point lies no reading tells: the job states it, or the sheet says what was taken for granted.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from pydantic import Field

from zlmreport.plugin import Axis, AxisKind, InputError, Options, Words, read_only_floats
from zlmreport.plugin.controller import CompensationTable
from zlmreport_plugins.controllers.on_paper.formats import OnPaper, decode, make_columns

#: The unit in which controls usually count, mm or °.
COUNTED = 1e-3
#: Of a step, by how much a row may stand off what the control counts.
_OFF_THE_ROW = 1e-4
FROM_THE_REFERENCE = Words(
    "The control counts rows from the reference point of the axis, in whole intervals, and has zero there. "
    "What it does beyond the last row on either side was not found in print: be careful there."
)
_REFERENCE_ASSUMED = Words(
    "Taken for granted: the reference point of the axis lies at position 0 of this test. If it lies "
    "elsewhere the table acts at shifted positions: state compensation.reference_position."
)
_UNIT_ASSUMED = Words(
    "Taken for granted: the control counts in {unit}. If it counts in another unit each value is wrong by "
    "that factor: state compensation.{key}."
)


class ReferenceOptions(Options):
    """The key of controls that count rows from the reference point."""

    reference_position: float | None = Field(
        None,
        description="Position of the reference point of the axis, mm (°), in the positions of the test; "
        "without it 0, which the sheet says.",
    )


class OnCountedRows(OnPaper):
    """What controls share that count rows from the reference point."""

    is_equidistant = True

    def find_reference(self, axis: Axis, options: Any) -> float:
        """Return where rows are counted from, m or rad."""
        return _find_reference(axis, options)


def _find_reference(axis: Axis, options: Any) -> float:
    return axis.position_unit.to_si(options.reference_position or 0.0)


def count_rows(table: CompensationTable, options: Any) -> list[int]:
    """Return the number of each row, counted from the reference point; refuse rows that stand between."""
    places = table.positions - _find_reference(table.axis, options)
    step = float(places[-1] - places[0]) / (len(places) - 1)
    numbers = np.round(places / step).astype(int)
    if np.abs(places - step * numbers).max() > _OFF_THE_ROW * step or np.any(np.diff(numbers) != 1):
        raise InputError.at(
            table.place,
            "the control counts rows in whole steps from the reference point, and these stand between",
        )
    found: list[int] = numbers.tolist()
    if found[0] > 0 or found[-1] < 0:
        raise InputError.at(table.place, "no row stands at the reference point of the axis")
    return found


def make_increments(
    table: CompensationTable, options: Any, quantum: float, largest: int, remedy: str
) -> dict[int, int]:
    """Return −Δe in whole quanta for each section, by the number of the row at which it ends.

    The running sum is rounded, so that nothing drifts; it is zero at the reference point, row 0.
    """
    _, forward, reverse = make_columns(table)
    numbers, mean = count_rows(table, options), (forward + reverse) / 2
    sums = np.round(-(mean - mean[numbers.index(0)]) / quantum).astype(int)
    steps: list[int] = np.diff(sums).tolist()
    worst = max(map(abs, steps))
    if worst > largest:
        raise InputError.at(
            table.place, f"a step of {worst} is more than the control takes, {largest}; {remedy}"
        )
    return dict(zip(numbers[1:], steps, strict=True))


def sum_increments(
    table: CompensationTable, options: Any, steps: Mapping[int, int], quantum: float
) -> CompensationTable:
    """Return what sections take away, each by the number of the row at which it ends; the rows are theirs."""
    numbers = sorted(steps)
    sums = -quantum * np.cumsum([0.0, *(steps[each] for each in numbers)])
    rows = np.arange(numbers[0] - 1, numbers[-1] + 1)
    sums -= sums[rows.tolist().index(0)]
    step = float(table.positions[-1] - table.positions[0]) / (len(table.positions) - 1)
    at = read_only_floats(_find_reference(table.axis, options) + step * rows)
    places = table.axis.position_unit.from_si(at)
    return decode(table, places.tolist(), sums.tolist(), sums.tolist())


def list_assumed_of(table: CompensationTable, options: Any, unit: float | None, key: str) -> Iterator[Words]:
    """Yield what was taken for granted: where the reference point is, in which unit the control counts."""
    if options.reference_position is None:
        yield _REFERENCE_ASSUMED
    if unit is not None:
        said = "{value} mm" if table.axis.kind is AxisKind.LINEAR else "{value}°"
        yield _UNIT_ASSUMED.given(unit=Words(said).given(value=unit), key=key)
