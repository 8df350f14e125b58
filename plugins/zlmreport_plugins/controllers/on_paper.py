"""Tables for Siemens, ISG, FANUC, Mitsubishi, HEIDENHAIN, Etalon, Beckhoff: not tried on a control yet.

ISG, Siemens and Mitsubishi document format and sign; of the others the sign or the file is not confirmed. All
are written with ``--unconfirmed`` only, and each says so on the sheet.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import pairwise
from typing import Any

import numpy as np
from pydantic import Field

from zlmreport.plugin import FloatArray, InputError, Options, Words, hookimpl, read_only_floats
from zlmreport.plugin.controller import CompensationTable, Controller, CrossTable

_NUMBER = r"([-+]?\d+(?:\.\d+)?)"
_AXIS = r"^[A-Z][A-Z0-9]{0,7}$"
_NO_TRIAL = Words(
    "This format was never tried on the control. Load it with the axis clear, and check one point first."
)
_MEAN_ONLY = Words("The table has the mean of both directions; the play is left to the backlash parameter.")
_ZERO_AT_THE_START = Words("The first row is zero: the constant before it was taken out.")
_FROM_THE_REFERENCE = Words(
    "The control counts rows from the reference point, in whole intervals. Where none of these rows lies "
    "there, the table acts at shifted positions."
)


class _OnPaper:
    """What these controls share: a file, read back as it is documented."""

    confidence = "unconfirmed"
    is_directional = False
    is_equidistant = False
    notes: tuple[Words, ...] = (_NO_TRIAL, _MEAN_ONLY)
    options: type[Options] = Options


def _join_lines(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in lines)


def _refuse_more_than(rows: int, table: CompensationTable) -> None:
    if len(table.positions) > rows:
        raise InputError.at(table.place, f"the control takes {rows} rows; state a longer step")


def _make_columns(table: CompensationTable) -> tuple[list[float], FloatArray, FloatArray]:
    """Return positions, mm or °, and the deviations forward and reverse in the same unit; refuse a fall."""
    unit = table.axis.position_unit
    positions = [round(unit.from_si(each), 6) for each in table.positions.tolist()]
    if len(positions) < 2 or any(b <= a for a, b in pairwise(positions)):
        raise InputError.at(table.place, "the rows of a table rise, and it has two at least")
    return positions, unit.from_si(table.forward), unit.from_si(table.reverse)


def _name_axis(table: CompensationTable, options: Any, end: str = "") -> str:
    """Return how the file calls the axis; refuse what no control takes."""
    name: str = options.axis or f"{table.axis.name.strip().upper()}{end}"
    if not re.match(_AXIS, name):
        raise InputError.at(
            table.place,
            f"{name[:32]!r} is no name of an axis on this control; state its key axis, such as X{end}",
        )
    return name


def _write_grid(positions: Sequence[float]) -> tuple[str, str, str]:
    """Return distance, first and last of rows equally far apart, as they are written.

    The last is as many written distances from the first as there are intervals: a distance that was rounded
    up would leave room for one row less before a last row that was not.
    """
    count = len(positions) - 1
    step = Decimal(f"{(positions[-1] - positions[0]) / count:.6f}")
    first = Decimal(f"{positions[0]:.6f}")
    return f"{step}", f"{first}", f"{first + count * step}"


def _write_short(value: float) -> str:
    return f"{value + 0.0:.6f}".rstrip("0").rstrip(".")


def _decode(
    table: CompensationTable, positions: Iterable[float], forward: Iterable[float], reverse: Iterable[float]
) -> CompensationTable:
    to_si = table.axis.position_unit.to_si
    grid, up, down = (
        read_only_floats([to_si(float(each)) for each in column]) for column in (positions, forward, reverse)
    )
    return replace(table, positions=grid, forward=up, reverse=down)


def _make_increments(table: CompensationTable, quantum: float, largest: int, remedy: str) -> list[int]:
    """Return −Δe of each interval in whole quanta; the running sum is rounded, so that nothing drifts."""
    _, forward, reverse = _make_columns(table)
    mean = (forward + reverse) / 2
    sums = np.round(-(mean - mean[0]) / quantum).astype(int)
    steps: list[int] = np.diff(sums).tolist()
    worst = max(map(abs, steps))
    if worst > largest:
        raise InputError.at(
            table.place, f"a step of {worst} is more than the control takes, {largest}; {remedy}"
        )
    return steps


def _sum_increments(table: CompensationTable, steps: Iterable[int], quantum: float) -> CompensationTable:
    sums = -quantum * np.concatenate([[0.0], np.cumsum(list(steps))])
    positions = table.axis.position_unit.from_si(table.positions)
    return _decode(table, positions.tolist(), sums.tolist(), sums.tolist())


class _Cross:
    """CEC across axes: one axis moves, another is moved aside. The sign is whoever loads it to state."""

    cross_sign = "stated"
    cross_notes = (
        _NO_TRIAL,
        Words(
            "MD18342 holds the number of points; MD32710 of the axis that is moved aside is 0 while the "
            "tables are loaded, then 1. The tables are numbered from 0: nothing else may stand there."
        ),
    )

    def cross_files(self, tables: Sequence[CrossTable], moves: int) -> Mapping[str, str]:
        """Return the one file: the value that moves the axis by −e, in both directions of travel."""
        lines: list[str] = []
        for number, table in enumerate(tables):
            values = (-moves * table.values * 1e3).tolist()
            axes = (f"{table.input}1", f"{table.output}1")
            lines += _write_cec(number, axes, (table.positions * 1e3).tolist(), values, direction=0)
        return {"-across_CEC.INI": _join_lines((*_CEC_BEGINS, *lines, "M17"))}

    def read_cross(
        self, files: Mapping[str, str], tables: Sequence[CrossTable], moves: int
    ) -> tuple[CrossTable, ...]:
        """Return the tables that the lines describe."""
        (text,) = files.values()
        return tuple(_read_cross_cec(text, number, table, moves) for number, table in enumerate(tables))


_CEC_BEGINS = ("%_N_NC_CEC_INI", "CHANDATA(1)")


def _write_cec(
    number: int, axes: tuple[str, str], positions: Sequence[float], values: Iterable[float], direction: int
) -> Iterator[str]:
    """Yield the lines of one table; `axes`: the one that moves, and the one that is moved aside."""
    step, first, last = _write_grid(positions)
    for row, each in enumerate(values):
        yield f"$AN_CEC[{number},{row}]={each + 0.0:.5f}"
    for name, value in (
        ("INPUT_AXIS", f"({axes[0]})"),
        ("OUTPUT_AXIS", f"({axes[1]})"),
        ("STEP", step),
        ("MIN", first),
        ("MAX", last),
        ("DIRECTION", direction),
        ("MULT_BY_TABLE", 0),
        ("IS_MODULO", 0),
    ):
        yield f"$AN_CEC_{name}[{number}]={value}"


def _read_grid(text: str, index: str, rows: int) -> list[float]:
    """Return positions by the stated distance and first of rows; `index`: In the brackets, a pattern."""
    step, first = (
        float(each) for name in ("STEP", "MIN") for each in re.findall(rf"{name}\[{index}\]={_NUMBER}", text)
    )
    return [first + step * row for row in range(rows)]


def _read_cec(text: str, number: int) -> list[float]:
    return [float(each) for each in re.findall(rf"CEC\[{number},\d+\]={_NUMBER}", text)]


def _read_cross_cec(text: str, number: int, table: CrossTable, moves: int) -> CrossTable:
    values = _read_cec(text, number)
    (moving,), (aside,) = (
        re.findall(rf"{which}_AXIS\[{number}\]=\((\w+?)1\)", text) for which in ("INPUT", "OUTPUT")
    )
    return replace(
        table,
        input=moving,
        output=aside,
        positions=read_only_floats(np.array(_read_grid(text, str(number), len(values))) * 1e-3),
        values=-moves * np.array(values) * 1e-3,
    )


class NamedAxisOptions(Options):
    """The key of controls whose files name the axis."""

    axis: str | None = Field(
        None, pattern=_AXIS, description="Name of the axis on the control; without it the axis's name."
    )


class SiemensOptions(Options):
    """The keys of ``siemens-840d``."""

    axis: str | None = Field(
        None, pattern=_AXIS, description="Machine axis; without it the axis's name with a 1."
    )


class Siemens840d(_OnPaper):
    """SINUMERIK 840D, encoder compensation (EEC, ``$AA_ENC_COMP``): a positive value is +e."""

    identifier = "siemens-840d"
    title = Words("Siemens SINUMERIK 840D (EEC)")
    confidence = "documented"
    is_equidistant = True
    options: type[Options] = SiemensOptions
    notes: tuple[Words, ...] = (
        *_OnPaper.notes,
        Words(
            "MD38000 holds the number of points; MD32700 is 0 while the table is loaded, then 1. The control "
            "expects zero at the reference point: by what the table has there the axis moves when it is "
            "referenced."
        ),
    )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file."""
        positions, forward, reverse = _make_columns(table)
        name = _name_axis(table, options, "1")
        mean = ((forward + reverse) / 2).tolist()
        step, first, last = _write_grid(positions)
        lines = ["%_N_AX_EEC_INI", "CHANDATA(1)"]
        lines += [f"$AA_ENC_COMP[0,{row},{name}]={each + 0.0:.5f}" for row, each in enumerate(mean)]
        lines += [
            f"$AA_ENC_COMP_STEP[0,{name}]={step}",
            f"$AA_ENC_COMP_MIN[0,{name}]={first}",
            f"$AA_ENC_COMP_MAX[0,{name}]={last}",
            f"$AA_ENC_COMP_IS_MODULO[0,{name}]=0",
            "M17",
        ]
        return {"_EEC.INI": _join_lines(lines)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the table that the lines describe."""
        text = files["_EEC.INI"]
        values = [float(each) for each in re.findall(rf"COMP\[0,\d+,\w+\]={_NUMBER}", text)]
        return _decode(table, _read_grid(text, r"0,\w+", len(values)), values, values)


class Siemens840dCec(_Cross, _OnPaper):
    """SINUMERIK 840D, compensation of an axis by itself (CEC): a table for each direction, +e as in EEC.

    The maker documents the variables; of the sign nothing was found, and it is taken for that of EEC.
    """

    identifier = "siemens-840d-cec"
    title = Words("Siemens SINUMERIK 840D (CEC)")
    is_directional = True
    is_equidistant = True
    options: type[Options] = SiemensOptions
    notes: tuple[Words, ...] = (
        _NO_TRIAL,
        Words(
            "The sign of these tables was not found in print; it is taken for that of EEC. MD18342 holds "
            "the number of points; MD32710 is 0 while the tables are loaded, then 1."
        ),
    )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file: table 0 acts in the positive direction, table 1 in the negative."""
        positions, *values = _make_columns(table)
        name = _name_axis(table, options, "1")
        lines: list[str] = []
        for number, (column, direction) in enumerate(zip(values, (1, -1), strict=True)):
            lines += _write_cec(number, (name, name), positions, column.tolist(), direction)
        return {"_CEC.INI": _join_lines((*_CEC_BEGINS, *lines, "M17"))}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return both tables."""
        text = files["_CEC.INI"]
        columns = [_read_cec(text, number) for number in (0, 1)]
        return _decode(table, _read_grid(text, "0", len(columns[0])), *columns)


class Isg(_OnPaper):
    """ISG and TwinCAT CNC (TF5200): ``kw.ssfk`` lists, +e by direction in whole 0.1 µm."""

    identifier = "isg"
    title = Words("ISG, TwinCAT CNC (kw.ssfk)")
    confidence = "documented"
    is_directional = True
    options: type[Options] = NamedAxisOptions
    notes: tuple[Words, ...] = (_NO_TRIAL,)

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file; set positions are in whole 0.1 µm (0.0001°), too."""
        positions, forward, reverse = _make_columns(table)
        lines = [
            "kopf.achs_nr 1",
            f"kopf.log_achs_name {_name_axis(table, options)}",
            "kw.ssfk.interval 0",
            f"kw.ssfk.kw_startpos {round(positions[0] * 1e4)}",
            f"kw.ssfk.kw_nr_max {len(positions)}",
            "kw.ssfk.unit 1",
            "kw.ssfk.bilateral 1",
        ]
        for row, (at, up, down) in enumerate(zip(positions, forward.tolist(), reverse.tolist(), strict=True)):
            lines += [
                f"kw.ssfk.table[{row}].setpoint {round(at * 1e4)}",
                f"kw.ssfk.table[{row}].pos {round(up * 1e4)}",
                f"kw.ssfk.table[{row}].neg {round(down * 1e4)}",
            ]
        return {".lis": _join_lines(lines)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the table of the list."""
        found = (
            [int(each) / 1e4 for each in re.findall(rf"\]\.{name} (-?\d+)", files[".lis"])]
            for name in ("setpoint", "pos", "neg")
        )
        return _decode(table, *found)


#: Number of a row.
_LAST_OF_FANUC = 1023


class FanucOptions(Options):
    """The keys of ``fanuc``."""

    reference: int = Field(
        40,
        ge=0,
        le=_LAST_OF_FANUC,
        description="Number of the first row; its increments have the numbers after it.",
    )
    magnification: int = Field(1, ge=1, le=100, description="Parameter 3623.")
    reverse: int | None = Field(
        None,
        ge=0,
        le=_LAST_OF_FANUC,
        description="Number of the first row moving back (parameter 3626), for a control that compensates "
        "both directions (3605#0); without it one table has their mean.",
    )


class Fanuc(_OnPaper):
    """Fanuc pitch error compensation: −Δe of each interval in units of 1 µm times parameter 3623."""

    identifier = "fanuc"
    title = Words("Fanuc (pitch error compensation)")
    most_rows = 128  # of old controls
    is_equidistant = True
    options: type[Options] = FanucOptions
    notes: tuple[Words, ...] = (
        _NO_TRIAL,
        _ZERO_AT_THE_START,
        _FROM_THE_REFERENCE,
        Words(
            "The second file has the parameters that the table needs. One table has the mean of both "
            "directions, and the play is left to parameter 1851. With the key reverse there are two, and "
            "1851 must be 0; the sign of 3627 is not confirmed. Power off and a reference return make them "
            "effective."
        ),
    )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the file, and the parameters.

        The value at a number belongs to the interval before it.
        """
        _refuse_more_than(self.most_rows, table)
        quantum, rows = options.magnification * 1e-3, len(table.positions)
        last = max(options.reference, options.reverse or 0) + rows - 1
        if last > _LAST_OF_FANUC:
            raise InputError.at(
                table.place,
                f"the last row has the number {last}, and the control takes up to {_LAST_OF_FANUC}; state a "
                "smaller reference or reverse, or a longer step",
            )
        remedy = "raise magnification (3623), or state a shorter step"
        positions, forward, reverse = _make_columns(table)
        unit = table.axis.position_unit.ascii
        interval = _write_short((positions[-1] - positions[0]) / (rows - 1))
        parameters = [f"3623 {options.magnification}", f"3624 {interval} {unit}"]
        if options.reverse is None:
            steps = {options.reference: _make_increments(table, quantum, 7, remedy)}
        elif abs(options.reverse - options.reference) < rows:
            raise InputError.at(
                table.place,
                f"the rows of both directions overlap: {rows} from {options.reference} and from "
                f"{options.reverse}; state another reverse",
            )
        else:
            steps = {
                first: _make_increments(replace(table, forward=column, reverse=column), quantum, 7, remedy)
                for first, column in ((options.reference, table.forward), (options.reverse, table.reverse))
            }
            apart = round(-float(reverse[0] - forward[0]) / quantum)
            parameters += ["3605#0 1", f"3626 {options.reverse}", f"3627 {apart}"]
        return {".txt": self._write_file(steps), "-parameters.txt": _join_lines(parameters)}

    def _write_file(self, steps: Mapping[int, Sequence[int]]) -> str:
        lines = [
            f"N1{first + row:04d}P{step}"
            for first, column in steps.items()
            for row, step in enumerate(column, start=1)
        ]
        return _join_lines(("%", *lines, "%"))

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the sums of the increments; moving back they begin with parameter 3627."""
        steps = [int(each) for each in re.findall(r"N\d+P(-?\d+)", files[".txt"])]
        quantum = options.magnification * 1e-3
        if options.reverse is None:
            return _sum_increments(table, steps, quantum)
        half = len(steps) // 2
        (apart,) = re.findall(r"^3627 (-?\d+)", files["-parameters.txt"], re.MULTILINE)
        forward, reverse = (_sum_increments(table, part, quantum) for part in (steps[:half], steps[half:]))
        offset = table.axis.position_unit.to_si(-int(apart) * quantum)
        return replace(forward, reverse=read_only_floats(reverse.forward + offset))


class Mitsubishi(_OnPaper):
    """Mitsubishi memory pitch error compensation: −Δe times 2 in output units of 0.001 mm, ± 127."""

    identifier = "mitsubishi"
    title = Words("Mitsubishi (memory pitch error)")
    confidence = "documented"
    is_equidistant = True
    notes: tuple[Words, ...] = (*_OnPaper.notes, _ZERO_AT_THE_START, _FROM_THE_REFERENCE)

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:  # noqa: ARG002
        """Return the increments, one a line, to be typed in at the control."""
        steps = _make_increments(table, 0.5e-3, 127, "state a shorter step")
        return {"-increments.txt": _join_lines(f"{row} {step}" for row, step in enumerate(steps, start=1))}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the sums of the increments."""
        steps = [int(line.split()[1]) for line in files["-increments.txt"].splitlines()]
        return _sum_increments(table, steps, 0.5e-3)


class Heidenhain(_OnPaper):
    """HEIDENHAIN ``.COM`` and ``.CMA``: position, play, deviation forward, mm; which axis has which table.

    The columns are documented (NR, AXISPOS, BACKLASH, the axis; NR, ACTIVE, the axis), at most 256 rows; head
    and sign are not confirmed.
    """

    identifier = "heidenhain"
    title = Words("HEIDENHAIN (.COM)")
    most_rows = 256
    is_directional = True
    options: type[Options] = NamedAxisOptions
    notes: tuple[Words, ...] = (
        _NO_TRIAL,
        Words(
            "The .CMA file names this table for the axis alone: add its line to that of the control, "
            "which may name tables of other axes, and mark it active (*)."
        ),
    )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the table, and the line that gives it to the axis."""
        _refuse_more_than(self.most_rows, table)
        name = _name_axis(table, options)
        assigned = ("BEGIN CONFIG .CMA", f"NR ACTIVE {name}", f"0  *      {table.number}.COM", "[END]")
        lines = [f"BEGIN {name}_AXIS .COM", f"NR AXISPOS  BACKLASH  {name}"]
        for row, (at, up, down) in enumerate(zip(*_make_columns(table), strict=True)):
            lines.append(f"{row}     {at:+.4f}   {float(down - up) + 0.0:+.4f}   {float(up) + 0.0:+.4f}")
        return {".COM": _join_lines((*lines, "[END]")), ".CMA": _join_lines(assigned)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the rows."""
        rows = [[float(each) for each in line.split()] for line in files[".COM"].splitlines()[2:-1]]
        _, positions, play, forward = zip(*rows, strict=True)
        return _decode(table, positions, forward, [up + gap for up, gap in zip(forward, play, strict=True)])


class Etalon(_OnPaper):
    """The exchange format of Etalon: grid points and deviations, mm."""

    identifier = "etalon"
    title = Words("Etalon exchange format")
    options: type[Options] = NamedAxisOptions

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file; its section is named by the axis: EXX for X."""
        positions, forward, reverse = _make_columns(table)
        section = f"E{_name_axis(table, options) * 2}"
        rows = [
            f"{_write_short(at)} {each + 0.0:.6f}"
            for at, each in zip(positions, ((forward + reverse) / 2).tolist(), strict=True)
        ]
        return {
            "-etalon.txt": _join_lines((f"[{section}]", "Gridpoints = {", *rows, f"}} // end of {section}"))
        }

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the grid points."""
        rows = [line.split() for line in files["-etalon.txt"].splitlines()[2:-1]]
        values = [float(each) for _, each in rows]
        return _decode(table, [float(at) for at, _ in rows], values, values)


class Beckhoff(_OnPaper):
    """Beckhoff NC PTP: elements of ``ST_CompensationElement`` by direction, the correction −e in mm."""

    identifier = "beckhoff"
    title = Words("Beckhoff TwinCAT NC PTP")
    is_directional = True
    notes: tuple[Words, ...] = (_NO_TRIAL,)

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:  # noqa: ARG002
        """Return the elements of each direction as structured text."""
        positions, forward, reverse = _make_columns(table)
        return {
            end: "".join(
                f"(fPos := {at:.6f}, fCompensation := {0.0 - each:.6f}),\n"
                for at, each in zip(positions, values.tolist(), strict=True)
            )
            for end, values in (("-positive.st", forward), ("-negative.st", reverse))
        }

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the elements."""
        pattern = rf"fPos := {_NUMBER}, fCompensation := {_NUMBER}"
        forward, reverse = (re.findall(pattern, files[end]) for end in ("-positive.st", "-negative.st"))
        return _decode(
            table,
            [float(at) for at, _ in forward],
            [-float(each) for _, each in forward],
            [-float(each) for _, each in reverse],
        )


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return all of them."""
    return [Beckhoff(), Etalon(), Fanuc(), Heidenhain(), Isg(), Mitsubishi(), Siemens840d(), Siemens840dCec()]
