"""FANUC: pitch error compensation by numbered sections, with the parameters that it needs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from pydantic import Field

from zlmreport.plugin import AxisKind, InputError, Options, Words, hookimpl, read_only_floats
from zlmreport.plugin.controller import CompensationTable, Controller
from zlmreport_plugins.controllers.on_paper.counted_rows import (
    COUNTED,
    FROM_THE_REFERENCE,
    OnCountedRows,
    ReferenceOptions,
    count_rows,
    list_assumed_of,
    make_increments,
    sum_increments,
)
from zlmreport_plugins.controllers.on_paper.formats import (
    NO_TRIAL,
    join_lines,
    make_columns,
    refuse_more_than,
    write_short,
)

#: The last number that a row may have.
_LAST = 1023


class FanucOptions(ReferenceOptions):
    """The keys of ``fanuc``."""

    reference: int = Field(
        40,
        ge=0,
        le=_LAST,
        description="Number of the row at the reference point (parameter 3620).",
    )
    magnification: int = Field(1, ge=1, le=100, description="Parameter 3623.")
    detection_unit: float | None = Field(
        None, gt=0, description="Detection unit of the axis, mm (°); without it 0.001, which the sheet says."
    )
    reverse: int | None = Field(
        None,
        ge=1,
        le=_LAST,
        description="Number of the first increment moving back (parameter 3626), for a control that "
        "compensates both directions (3605#0); without it one table has their mean.",
    )


class Fanuc(OnCountedRows):
    """Fanuc pitch error compensation: −Δe of each interval in detection units times parameter 3623.

    The value at a number belongs to the interval before it; the reference point has the number of parameter
    3620. The numbers of a rotary axis that turns round begin there.
    """

    identifier = "fanuc"
    title = Words("Fanuc (pitch error compensation)")
    most_rows = 128  # of old controls
    options: type[Options] = FanucOptions
    notes: tuple[Words, ...] = (
        NO_TRIAL,
        FROM_THE_REFERENCE,
        Words(
            "The second file has the parameters that the table needs. One table has the mean of both "
            "directions, and the play is left to parameter 1851. With the key reverse there are two, and "
            "1851 must be 0; 3627 holds for a reference return in the positive direction, and its sign is "
            "not confirmed. Power off and a reference return make them effective."
        ),
    )

    def list_assumed(self, table: CompensationTable, options: Any) -> Iterator[Words]:
        """Yield what was taken for granted."""
        yield from list_assumed_of(
            table, options, None if options.detection_unit else COUNTED, "detection_unit"
        )
        if table.axis.kind is AxisKind.ROTARY and not table.is_closed:
            yield Words(
                "Taken for granted: the axis does not turn round and round (3625 is not used). On one that "
                "does, the sum of this table would grow with each turn."
            )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the file, and the parameters."""
        refuse_more_than(self.most_rows, table)
        rows = len(table.positions)
        quantum = options.magnification * (options.detection_unit or COUNTED)
        remedy = "raise magnification (3623), or state a shorter step"
        positions, forward, reverse = make_columns(table)
        numbers = count_rows(table, options)
        begin = 0 if table.is_closed else numbers[1]
        first, last = options.reference + begin, options.reference + numbers[-1]
        unit, count = table.axis.position_unit.ascii, last - first + 1
        interval = write_short((positions[-1] - positions[0]) / (rows - 1))
        parameters = [
            f"3620 {options.reference}",
            f"3621 {first}",
            f"3622 {last}",
            f"3623 {options.magnification}",
            f"3624 {interval} {unit}",
            *([f"3625 360 {unit}"] if table.is_closed else []),
        ]
        if options.reverse is None:
            steps = {options.reference: make_increments(table, options, quantum, 7, remedy)}
        elif abs(options.reverse - first) < count:
            raise InputError.at(
                table.place,
                f"the rows of both directions overlap: {count} from {first} and from {options.reverse}; "
                "state another reverse",
            )
        else:
            steps = {
                zero: make_increments(
                    replace(table, forward=column, reverse=column), options, quantum, 7, remedy
                )
                for zero, column in (
                    (options.reference, table.forward),
                    (options.reverse - begin, table.reverse),
                )
            }
            at = numbers.index(0)
            apart = round(-float(reverse[at] - forward[at]) / quantum)
            parameters += ["3605#0 1", f"3626 {options.reverse}", f"3627 {apart}"]
        for end in (first, last, options.reverse and options.reverse + count - 1):
            if end is not None and not 0 <= end <= _LAST:
                raise InputError.at(
                    table.place,
                    f"a row has the number {end}, and those of the control go from 0 to {_LAST}; "
                    "state another reference or reverse, or a longer step",
                )
        return {".txt": self._write_file(steps, table), "-parameters.txt": join_lines(parameters)}

    def _write_file(self, steps: Mapping[int, Mapping[int, int]], table: CompensationTable) -> str:
        """Return the increments; of a table that goes round the first number has the last one's, too."""
        lines = []
        for zero, column in steps.items():
            if table.is_closed:
                lines.append(f"N1{zero:04d}P{column[len(column)]}")
            lines += [f"N1{zero + row:04d}P{step}" for row, step in column.items()]
        return join_lines(("%", *lines, "%"))

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the sums of the increments; moving back they begin with parameter 3627."""
        entered = {int(number): int(step) for number, step in re.findall(r"N1(\d{4})P(-?\d+)", files[".txt"])}
        quantum = options.magnification * (options.detection_unit or COUNTED)
        count = len(entered) // (1 if options.reverse is None else 2)
        back = range(0) if options.reverse is None else range(options.reverse, options.reverse + count)
        ahead = sorted(number for number in entered if number not in back)
        shift = 0 if options.reverse is None else options.reverse - ahead[0]
        ahead = ahead[table.is_closed :]

        def sum_moved(shift: int) -> CompensationTable:
            steps = {number - options.reference: entered[number + shift] for number in ahead}
            return sum_increments(table, options, steps, quantum)

        if options.reverse is None:
            return sum_moved(0)
        (apart,) = re.findall(r"^3627 (-?\d+)", files["-parameters.txt"], re.MULTILINE)
        offset = table.axis.position_unit.to_si(-int(apart) * quantum)
        return replace(sum_moved(0), reverse=read_only_floats(sum_moved(shift).forward + offset))


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the control."""
    return [Fanuc()]
