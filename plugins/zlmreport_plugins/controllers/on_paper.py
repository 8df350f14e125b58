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
from typing import Any, Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    Axis,
    AxisKind,
    FloatArray,
    InputError,
    Options,
    Words,
    hookimpl,
    read_only_floats,
)
from zlmreport.plugin.controller import CompensationTable, Controller, CrossTable

#: Of a step, by how much a row may stand off what the control counts.
_OFF_THE_ROW = 1e-4
_NUMBER = r"([-+]?\d+(?:\.\d+)?)"
_AXIS = r"^[A-Z][A-Z0-9]{0,7}$"
_NO_TRIAL = Words(
    "This format was never tried on the control. Load it with the axis clear, and check one point first."
)
_MEAN_ONLY = Words("The table has the mean of both directions; the play is left to the backlash parameter.")
_FROM_THE_REFERENCE = Words(
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


class ReferenceOptions(Options):
    """The key of controls that count rows from the reference point."""

    reference_position: float | None = Field(
        None,
        description="Position of the reference point of the axis, mm (°), in the positions of the test; "
        "without it 0, which the sheet says.",
    )


def _find_reference(axis: Axis, options: Any) -> float:
    """Return where rows are counted from, m or rad."""
    return axis.position_unit.to_si(options.reference_position or 0.0)


def _count_rows(table: CompensationTable, options: Any) -> list[int]:
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


def _make_increments(
    table: CompensationTable, options: Any, quantum: float, largest: int, remedy: str
) -> dict[int, int]:
    """Return −Δe in whole quanta for each section, by the number of the row at which it ends.

    The running sum is rounded, so that nothing drifts; it is zero at the reference point, row 0.
    """
    _, forward, reverse = _make_columns(table)
    numbers, mean = _count_rows(table, options), (forward + reverse) / 2
    sums = np.round(-(mean - mean[numbers.index(0)]) / quantum).astype(int)
    steps: list[int] = np.diff(sums).tolist()
    worst = max(map(abs, steps))
    if worst > largest:
        raise InputError.at(
            table.place, f"a step of {worst} is more than the control takes, {largest}; {remedy}"
        )
    return dict(zip(numbers[1:], steps, strict=True))


def _sum_increments(
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
    return _decode(table, places.tolist(), sums.tolist(), sums.tolist())


def _list_assumed(
    table: CompensationTable, options: Any, unit: float | None = None, key: str = ""
) -> Iterator[Words]:
    """Yield what was taken for granted: where the reference point is, in which unit the control counts."""
    if options.reference_position is None:
        yield _REFERENCE_ASSUMED
    if unit is not None:
        said = "{value} mm" if table.axis.kind is AxisKind.LINEAR else "{value}°"
        yield _UNIT_ASSUMED.given(unit=Words(said).given(value=unit), key=key)


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


def _write_cec(  # noqa: PLR0913, PLR0917 - as many as the table has lines of its own
    number: int,
    axes: tuple[str, str],
    positions: Sequence[float],
    values: Iterable[float],
    direction: int,
    is_modulo: int = 0,
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
        ("IS_MODULO", is_modulo),
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
    """The key of ``siemens-840d-cec``."""

    axis: str | None = Field(
        None, pattern=_AXIS, description="Machine axis; without it the axis's name with a 1."
    )


class SiemensEncoderOptions(SiemensOptions):
    """The keys of ``siemens-840d``."""

    reference_position: float | None = Field(
        None,
        description="Position of the reference point of the axis, mm (°), in the positions of the test: the "
        "table is zero there.",
    )


def _find_zero(table: CompensationTable, options: Any) -> float:
    """Return what the table has at the reference point, mm or °; 0 where nobody stated where that is."""
    if options.reference_position is None:
        return 0.0
    unit = table.axis.position_unit
    at = read_only_floats([unit.to_si(options.reference_position)])
    return float(unit.from_si(table.at(at)).mean())


class Siemens840d(_OnPaper):
    """SINUMERIK 840D, encoder compensation (EEC, ``$AA_ENC_COMP``): a positive value is +e."""

    identifier = "siemens-840d"
    title = Words("Siemens SINUMERIK 840D (EEC)")
    confidence = "documented"
    is_equidistant = True
    options: type[Options] = SiemensEncoderOptions
    notes: tuple[Words, ...] = (
        *_OnPaper.notes,
        Words(
            "MD38000 holds the number of points; MD32700 is 0 while the table is loaded, then 1. The control "
            "expects zero at the reference point: by what the table has there the axis moves when it is "
            "referenced. The key reference_position takes that out."
        ),
        Words(
            "Beyond the first and the last row their values hold. Numbers are mm (°): so must be the "
            "control's system of units while the table is loaded (MD10240)."
        ),
    )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file."""
        positions, forward, reverse = _make_columns(table)
        name = _name_axis(table, options, "1")
        mean = ((forward + reverse) / 2 - _find_zero(table, options)).tolist()
        step, first, last = _write_grid(positions)
        lines = ["%_N_AX_EEC_INI", "CHANDATA(1)"]
        lines += [f"$AA_ENC_COMP[0,{row},{name}]={each + 0.0:.5f}" for row, each in enumerate(mean)]
        lines += [
            f"$AA_ENC_COMP_STEP[0,{name}]={step}",
            f"$AA_ENC_COMP_MIN[0,{name}]={first}",
            f"$AA_ENC_COMP_MAX[0,{name}]={last}",
            f"$AA_ENC_COMP_IS_MODULO[0,{name}]={int(table.is_closed)}",
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
            lines += _write_cec(
                number, (name, name), positions, column.tolist(), direction, int(table.is_closed)
            )
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
            *(["kw.ssfk.modulo 1"] if table.is_closed else []),
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


#: Number of a row, and the unit in which controls usually count, mm or °.
_LAST_OF_FANUC, _COUNTED = 1023, 1e-3


class FanucOptions(ReferenceOptions):
    """The keys of ``fanuc``."""

    reference: int = Field(
        40,
        ge=0,
        le=_LAST_OF_FANUC,
        description="Number of the row at the reference point (parameter 3620).",
    )
    magnification: int = Field(1, ge=1, le=100, description="Parameter 3623.")
    detection_unit: float | None = Field(
        None, gt=0, description="Detection unit of the axis, mm (°); without it 0.001, which the sheet says."
    )
    reverse: int | None = Field(
        None,
        ge=1,
        le=_LAST_OF_FANUC,
        description="Number of the first increment moving back (parameter 3626), for a control that "
        "compensates both directions (3605#0); without it one table has their mean.",
    )


class MitsubishiOptions(ReferenceOptions):
    """The keys of ``mitsubishi``."""

    output_unit: float | None = Field(
        None, gt=0, description="Output unit of the axis, mm (°); without it 0.001, which the sheet says."
    )


class Fanuc(_OnPaper):
    """Fanuc pitch error compensation: −Δe of each interval in detection units times parameter 3623.

    The value at a number belongs to the interval before it; the reference point has the number of parameter
    3620. The numbers of a rotary axis that turns round begin there.
    """

    identifier = "fanuc"
    title = Words("Fanuc (pitch error compensation)")
    most_rows = 128  # of old controls
    is_equidistant = True
    options: type[Options] = FanucOptions
    notes: tuple[Words, ...] = (
        _NO_TRIAL,
        _FROM_THE_REFERENCE,
        Words(
            "The second file has the parameters that the table needs. One table has the mean of both "
            "directions, and the play is left to parameter 1851. With the key reverse there are two, and "
            "1851 must be 0; 3627 holds for a reference return in the positive direction, and its sign is "
            "not confirmed. Power off and a reference return make them effective."
        ),
    )

    def find_reference(self, axis: Axis, options: Any) -> float:
        """Return where rows are counted from, m or rad."""
        return _find_reference(axis, options)

    def list_assumed(self, table: CompensationTable, options: Any) -> Iterator[Words]:
        """Yield what was taken for granted."""
        yield from _list_assumed(
            table, options, None if options.detection_unit else _COUNTED, "detection_unit"
        )
        if table.axis.kind is AxisKind.ROTARY and not table.is_closed:
            yield Words(
                "Taken for granted: the axis does not turn round and round (3625 is not used). On one that "
                "does, the sum of this table would grow with each turn."
            )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the file, and the parameters."""
        _refuse_more_than(self.most_rows, table)
        rows = len(table.positions)
        quantum = options.magnification * (options.detection_unit or _COUNTED)
        remedy = "raise magnification (3623), or state a shorter step"
        positions, forward, reverse = _make_columns(table)
        numbers = _count_rows(table, options)
        begin = 0 if table.is_closed else numbers[1]
        first, last = options.reference + begin, options.reference + numbers[-1]
        unit, count = table.axis.position_unit.ascii, last - first + 1
        interval = _write_short((positions[-1] - positions[0]) / (rows - 1))
        parameters = [
            f"3620 {options.reference}",
            f"3621 {first}",
            f"3622 {last}",
            f"3623 {options.magnification}",
            f"3624 {interval} {unit}",
            *([f"3625 360 {unit}"] if table.is_closed else []),
        ]
        if options.reverse is None:
            steps = {options.reference: _make_increments(table, options, quantum, 7, remedy)}
        elif abs(options.reverse - first) < count:
            raise InputError.at(
                table.place,
                f"the rows of both directions overlap: {count} from {first} and from {options.reverse}; "
                "state another reverse",
            )
        else:
            steps = {
                zero: _make_increments(
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
            if end is not None and not 0 <= end <= _LAST_OF_FANUC:
                raise InputError.at(
                    table.place,
                    f"a row has the number {end}, and those of the control go from 0 to {_LAST_OF_FANUC}; "
                    "state another reference or reverse, or a longer step",
                )
        return {".txt": self._write_file(steps, table), "-parameters.txt": _join_lines(parameters)}

    def _write_file(self, steps: Mapping[int, Mapping[int, int]], table: CompensationTable) -> str:
        """Return the increments; of a table that goes round the first number has the last one's, too."""
        lines = []
        for zero, column in steps.items():
            if table.is_closed:
                lines.append(f"N1{zero:04d}P{column[len(column)]}")
            lines += [f"N1{zero + row:04d}P{step}" for row, step in column.items()]
        return _join_lines(("%", *lines, "%"))

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the sums of the increments; moving back they begin with parameter 3627."""
        entered = {int(number): int(step) for number, step in re.findall(r"N1(\d{4})P(-?\d+)", files[".txt"])}
        quantum = options.magnification * (options.detection_unit or _COUNTED)
        count = len(entered) // (1 if options.reverse is None else 2)
        back = range(0) if options.reverse is None else range(options.reverse, options.reverse + count)
        ahead = sorted(number for number in entered if number not in back)
        shift = 0 if options.reverse is None else options.reverse - ahead[0]
        ahead = ahead[table.is_closed :]

        def summed(shift: int) -> CompensationTable:
            steps = {number - options.reference: entered[number + shift] for number in ahead}
            return _sum_increments(table, options, steps, quantum)

        if options.reverse is None:
            return summed(0)
        (apart,) = re.findall(r"^3627 (-?\d+)", files["-parameters.txt"], re.MULTILINE)
        offset = table.axis.position_unit.to_si(-int(apart) * quantum)
        return replace(summed(0), reverse=read_only_floats(summed(shift).forward + offset))


class Mitsubishi(_OnPaper):
    """Mitsubishi memory pitch error compensation: −Δe times 2 in output units, ± 127, of each interval.

    Of point n on the positive side it belongs to the interval from n − 1, on the negative from n + 1 on: both
    times to that towards the reference point, which has none. So the maker prints of the incremental system.
    """

    identifier = "mitsubishi"
    title = Words("Mitsubishi (memory pitch error)")
    confidence = "documented"
    is_equidistant = True
    options: type[Options] = MitsubishiOptions
    notes: tuple[Words, ...] = (
        *_OnPaper.notes,
        _FROM_THE_REFERENCE,
        Words(
            "Each line has the division point counted from the reference point (1, 2 … on its positive side, "
            "−1, −2 … on its negative), its value, and from where to where it acts. Which number of the "
            "control a point has follows from its parameters of the axis; the compensation scale is taken "
            "as 1."
        ),
    )

    def find_reference(self, axis: Axis, options: Any) -> float:
        """Return where rows are counted from, m or rad."""
        return _find_reference(axis, options)

    def list_assumed(self, table: CompensationTable, options: Any) -> Iterator[Words]:
        """Yield what was taken for granted."""
        yield from _list_assumed(table, options, None if options.output_unit else _COUNTED, "output_unit")
        if table.is_closed:
            yield Words("Taken for granted: the control repeats the table every turn.")

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the increments, one a line, to be typed in at the control."""
        quantum = (options.output_unit or _COUNTED) / 2
        steps = _make_increments(table, options, quantum, 127, "state a shorter step")
        positions = [_write_short(each) for each in _make_columns(table)[0]]
        return {
            "-increments.txt": _join_lines(
                f"{_name_point(row)} {step} {begin} {end}"
                for (row, step), (begin, end) in zip(steps.items(), pairwise(positions), strict=True)
            )
        }

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the sums of the increments."""
        rows = [line.split() for line in files["-increments.txt"].splitlines()]
        steps = {number if number > 0 else number + 1: int(step) for number, step in _list_points(rows)}
        return _sum_increments(table, options, steps, (options.output_unit or _COUNTED) / 2)


def _name_point(row: int) -> int:
    """Return the division point of a section that ends at a row: its end away from the reference point."""
    return row if row > 0 else row - 1


def _list_points(rows: Iterable[Sequence[str]]) -> Iterator[tuple[int, str]]:
    for number, step, *_ in rows:
        yield int(number), step


class HeidenhainOptions(NamedAxisOptions):
    """The keys of ``heidenhain``."""

    backlash: Literal["reverse", "play"] | None = Field(
        None,
        description="What the control wants in BACKLASH: the deviations moving back (reverse), or by how "
        "much they differ from those moving forward (play). Without it reverse, which the sheet says.",
    )


class Heidenhain(_OnPaper):
    """HEIDENHAIN ``.COM`` and ``.CMA``: position, deviation back and forward, mm; which axis has which table.

    The columns are documented (NR, AXISPOS, BACKLASH, the axis; NR, ACTIVE, the axis): at most 256 rows,
    equally far apart, and BACKLASH has what was measured in the negative direction (technical manual
    MANUALplus 620, 6.10). Head and sign are not confirmed.
    """

    identifier = "heidenhain"
    title = Words("HEIDENHAIN (.COM)")
    most_rows = 256
    is_directional = True
    is_equidistant = True
    options: type[Options] = HeidenhainOptions
    notes: tuple[Words, ...] = (
        _NO_TRIAL,
        Words(
            "The .CMA file names this table for the axis alone: add its line to that of the control, "
            "which may name tables of other axes, and mark it active (*)."
        ),
    )

    def list_assumed(self, table: CompensationTable, options: Any) -> Iterator[Words]:
        """Yield what BACKLASH was taken for, where that makes a difference."""
        if options.backlash is None and np.any(table.forward != table.reverse):
            yield Words(
                "Taken for granted: the column BACKLASH has the deviations moving back themselves, as the "
                "maker's manual of the MANUALplus 620 says. A control that wants only their difference there "
                "takes away too much: state compensation.backlash, reverse or play."
            )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the table, and the line that gives it to the axis."""
        _refuse_more_than(self.most_rows, table)
        name = _name_axis(table, options)
        assigned = ("BEGIN CONFIG .CMA", f"NR ACTIVE {name}", f"0  *      {table.number}.COM", "[END]")
        lines = [f"BEGIN {name}_AXIS .COM", f"NR AXISPOS  BACKLASH  {name}"]
        for row, (at, up, down) in enumerate(zip(*_make_columns(table), strict=True)):
            back = float(down - (up if options.backlash == "play" else 0.0))
            lines.append(f"{row}     {at:+.4f}   {back + 0.0:+.4f}   {float(up) + 0.0:+.4f}")
        return {".COM": _join_lines((*lines, "[END]")), ".CMA": _join_lines(assigned)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the rows."""
        rows = [[float(each) for each in line.split()] for line in files[".COM"].splitlines()[2:-1]]
        _, positions, back, forward = zip(*rows, strict=True)
        base = forward if options.backlash == "play" else (0.0,) * len(forward)
        return _decode(table, positions, forward, [each + gap for each, gap in zip(base, back, strict=True)])


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
