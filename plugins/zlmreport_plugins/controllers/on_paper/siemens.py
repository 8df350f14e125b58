"""Siemens SINUMERIK 840D: compensation by encoder (EEC), of an axis by itself, and by another (CEC)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import Field

from zlmreport.plugin import Options, Words, hookimpl, read_only_floats
from zlmreport.plugin.controller import CompensationTable, Controller, CrossTable
from zlmreport_plugins.controllers.on_paper.formats import (
    AXIS,
    NO_TRIAL,
    NUMBER,
    OnPaper,
    decode,
    join_lines,
    make_columns,
    name_axis,
    write_grid,
)

_CEC_BEGINS = ("%_N_NC_CEC_INI", "CHANDATA(1)")


class _Cross:
    """CEC across axes: one axis moves, another is moved aside. The sign is whoever loads it to state."""

    cross_sign = "stated"
    cross_notes = (
        NO_TRIAL,
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
        return {"-across_CEC.INI": join_lines((*_CEC_BEGINS, *lines, "M17"))}

    def read_cross(
        self, files: Mapping[str, str], tables: Sequence[CrossTable], moves: int
    ) -> tuple[CrossTable, ...]:
        """Return the tables that the lines describe."""
        (text,) = files.values()
        return tuple(_read_cross_cec(text, number, table, moves) for number, table in enumerate(tables))


def _write_cec(  # noqa: PLR0913, PLR0917 - as many as the table has lines of its own
    number: int,
    axes: tuple[str, str],
    positions: Sequence[float],
    values: Iterable[float],
    direction: int,
    is_modulo: int = 0,
) -> Iterator[str]:
    """Yield the lines of one table; `axes`: the one that moves, and the one that is moved aside."""
    step, first, last = write_grid(positions)
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
        float(each) for name in ("STEP", "MIN") for each in re.findall(rf"{name}\[{index}\]={NUMBER}", text)
    )
    return [first + step * row for row in range(rows)]


def _read_cec(text: str, number: int) -> list[float]:
    return [float(each) for each in re.findall(rf"CEC\[{number},\d+\]={NUMBER}", text)]


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


class SiemensOptions(Options):
    """The key of ``siemens-840d-cec``."""

    axis: str | None = Field(
        None, pattern=AXIS, description="Machine axis; without it the axis's name with a 1."
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


class Siemens840d(OnPaper):
    """SINUMERIK 840D, encoder compensation (EEC, ``$AA_ENC_COMP``): a positive value is +e."""

    identifier = "siemens-840d"
    title = Words("Siemens SINUMERIK 840D (EEC)")
    confidence = "documented"
    is_equidistant = True
    options: type[Options] = SiemensEncoderOptions
    notes: tuple[Words, ...] = (
        *OnPaper.notes,
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
        positions, forward, reverse = make_columns(table)
        name = name_axis(table, options, "1")
        mean = ((forward + reverse) / 2 - _find_zero(table, options)).tolist()
        step, first, last = write_grid(positions)
        lines = ["%_N_AX_EEC_INI", "CHANDATA(1)"]
        lines += [f"$AA_ENC_COMP[0,{row},{name}]={each + 0.0:.5f}" for row, each in enumerate(mean)]
        lines += [
            f"$AA_ENC_COMP_STEP[0,{name}]={step}",
            f"$AA_ENC_COMP_MIN[0,{name}]={first}",
            f"$AA_ENC_COMP_MAX[0,{name}]={last}",
            f"$AA_ENC_COMP_IS_MODULO[0,{name}]={int(table.is_closed)}",
            "M17",
        ]
        return {"_EEC.INI": join_lines(lines)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the table that the lines describe."""
        text = files["_EEC.INI"]
        values = [float(each) for each in re.findall(rf"COMP\[0,\d+,\w+\]={NUMBER}", text)]
        return decode(table, _read_grid(text, r"0,\w+", len(values)), values, values)


class Siemens840dCec(_Cross, OnPaper):
    """SINUMERIK 840D, compensation of an axis by itself (CEC): a table for each direction, +e as in EEC.

    The maker documents the variables; of the sign nothing was found, and it is taken for that of EEC.
    """

    identifier = "siemens-840d-cec"
    title = Words("Siemens SINUMERIK 840D (CEC)")
    is_directional = True
    is_equidistant = True
    options: type[Options] = SiemensOptions
    notes: tuple[Words, ...] = (
        NO_TRIAL,
        Words(
            "The sign of these tables was not found in print; it is taken for that of EEC. MD18342 holds "
            "the number of points; MD32710 is 0 while the tables are loaded, then 1."
        ),
    )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file: table 0 acts in the positive direction, table 1 in the negative."""
        positions, *values = make_columns(table)
        name = name_axis(table, options, "1")
        lines: list[str] = []
        for number, (column, direction) in enumerate(zip(values, (1, -1), strict=True)):
            lines += _write_cec(
                number, (name, name), positions, column.tolist(), direction, int(table.is_closed)
            )
        return {"_CEC.INI": join_lines((*_CEC_BEGINS, *lines, "M17"))}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return both tables."""
        text = files["_CEC.INI"]
        columns = [_read_cec(text, number) for number in (0, 1)]
        return decode(table, _read_grid(text, "0", len(columns[0])), *columns)


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the controls."""
    return [Siemens840d(), Siemens840dCec()]
