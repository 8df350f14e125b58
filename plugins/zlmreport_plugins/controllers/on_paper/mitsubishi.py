"""Mitsubishi: memory pitch error compensation by division points, to be typed in at the control."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from pydantic import Field

from zlmreport.plugin import Options, Words, hookimpl
from zlmreport.plugin.controller import CompensationTable, Controller
from zlmreport_plugins.controllers.on_paper.counted_rows import (
    COUNTED,
    FROM_THE_REFERENCE,
    OnCountedRows,
    ReferenceOptions,
    list_assumed_of,
    make_increments,
    sum_increments,
)
from zlmreport_plugins.controllers.on_paper.formats import OnPaper, join_lines, make_columns, write_short


class MitsubishiOptions(ReferenceOptions):
    """The keys of ``mitsubishi``."""

    output_unit: float | None = Field(
        None, gt=0, description="Output unit of the axis, mm (°); without it 0.001, which the sheet says."
    )


class Mitsubishi(OnCountedRows):
    """Mitsubishi memory pitch error compensation: −Δe times 2 in output units, ± 127, of each interval.

    Of point n on the positive side it belongs to the interval from n − 1, on the negative from n + 1 on: both
    times to that towards the reference point, which has none. So the maker prints of the incremental system.
    """

    identifier = "mitsubishi"
    title = Words("Mitsubishi (memory pitch error)")
    confidence = "documented"
    options: type[Options] = MitsubishiOptions
    notes: tuple[Words, ...] = (
        *OnPaper.notes,
        FROM_THE_REFERENCE,
        Words(
            "Each line has the division point counted from the reference point (1, 2 … on its positive side, "
            "−1, −2 … on its negative), its value, and from where to where it acts. Which number of the "
            "control a point has follows from its parameters of the axis; the compensation scale is taken "
            "as 1."
        ),
    )

    def list_assumed(self, table: CompensationTable, options: Any) -> Iterator[Words]:
        """Yield what was taken for granted."""
        yield from list_assumed_of(table, options, None if options.output_unit else COUNTED, "output_unit")
        if table.is_closed:
            yield Words("Taken for granted: the control repeats the table every turn.")

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the increments, one a line, to be typed in at the control."""
        quantum = (options.output_unit or COUNTED) / 2
        steps = make_increments(table, options, quantum, 127, "state a shorter step")
        positions = [write_short(each) for each in make_columns(table)[0]]
        return {
            "-increments.txt": join_lines(
                f"{_name_point(row)} {step} {begin} {end}"
                for (row, step), (begin, end) in zip(steps.items(), pairwise(positions), strict=True)
            )
        }

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the sums of the increments."""
        rows = [line.split() for line in files["-increments.txt"].splitlines()]
        steps = {number if number > 0 else number + 1: int(step) for number, step in _list_points(rows)}
        return sum_increments(table, options, steps, (options.output_unit or COUNTED) / 2)


def _name_point(row: int) -> int:
    """Return the division point of a section that ends at a row: its end away from the reference point."""
    return row if row > 0 else row - 1


def _list_points(rows: Iterable[Sequence[str]]) -> Iterator[tuple[int, str]]:
    for number, step, *_ in rows:
        yield int(number), step


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the control."""
    return [Mitsubishi()]
