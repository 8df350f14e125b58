"""LinuxCNC: `COMP_FILE` of a joint, types 0 and 1. Tried on the control itself (linuxcnc-uspace 2.9).

A row is three numbers: nominal, forward, reverse. Type 0 has the positions that the axis reached,
nominal + e; type 1 the trims, −e. The control reads up to the first line that is anything else, drops rows
that do not rise and those beyond 256, and says so at most in its log: what it would cut off is refused here.
Between two rows it interpolates, outside the end value holds.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import InputError, Options, Words, hookimpl, read_only_floats
from zlmreport.plugin.controller import CompensationTable, Controller, CrossTable

_MOST_ROWS = 256
_ROW = re.compile(r"\s*([-+.\deE]+)\s+([-+.\deE]+)\s+([-+.\deE]+)")
_END = ".comp"


class LinuxCncOptions(Options):
    """The keys of ``linuxcnc``."""

    type: Literal[0, 1] = Field(
        0, description="COMP_FILE_TYPE: 0 for positions that the axis reached, 1 for trims."
    )
    decimals: int = Field(6, ge=3, le=9, description="Digits after the decimal point.")


class _Matrix:
    """Squareness by LinuxCNC's kinematics `matrixkins`: joint = C · (x, y, z).

    LinuxCNC has no tables across axes: a `COMP_FILE` acts on its own joint. So straightness is left. That an
    entry C_xy moves X by so much for each unit of Y says LinuxCNC's own test of the module.
    """

    cross_sign = "known"
    cross_notes = (
        Words(
            "LinuxCNC has no tables across axes, so straightness is left: COMP_FILE acts on its own "
            "joint. Squareness is taken away by its kinematics: [KINS] KINEMATICS = matrixkins, and these "
            "lines in a HAL file. Releases before matrixkins have none. Never tried with a machine: measure "
            "one circle."
        ),
    )

    def cross_files(self, tables: Sequence[CrossTable], moves: int) -> Mapping[str, str]:  # noqa: ARG002 - it is known
        """Return the one file: −slope for each pair of axes that is not square."""
        lines = [
            f"setp matrixkins.C_{each.output.lower()}{each.input.lower()} {-each.slope:.9f}\n"
            for each in tables
            if each.slope
        ]
        return {"-square.hal": "".join(lines)} if lines else {}

    def read_cross(
        self,
        files: Mapping[str, str],
        tables: Sequence[CrossTable],
        moves: int,  # noqa: ARG002
    ) -> tuple[CrossTable, ...]:
        """Return what the kinematics take away: the slope alone."""
        entries = {
            name: float(value)
            for text in files.values()
            for name, value in re.findall(r"C_(\w\w) (\S+)", text)
        }
        slopes = [-entries.get(f"{each.output}{each.input}".lower(), 0.0) for each in tables]
        return tuple(
            replace(each, values=slope * (each.positions - each.positions[0]), slope=slope)
            for each, slope in zip(tables, slopes, strict=True)
            if slope
        )


class LinuxCnc(_Matrix):
    """LinuxCNC, `COMP_FILE` of a joint."""

    identifier = "linuxcnc"
    title = Words("LinuxCNC (COMP_FILE)")
    options: type[Options] = LinuxCncOptions
    confidence = "verified"
    is_directional = True
    is_equidistant = False
    most_rows = _MOST_ROWS
    notes: tuple[Words, ...] = (
        Words(
            "In the section of the joint state COMP_FILE and COMP_FILE_TYPE, and start LinuxCNC again. "
            "BACKLASH is ignored then: the table has both directions."
        ),
        Words("Between two rows LinuxCNC interpolates; outside the table the end value holds."),
        Words(
            "The format was tried on LinuxCNC 2.9. Its numbers are mm (°): so must be the units of the "
            "machine (LINEAR_UNITS)."
        ),
    )

    def files(self, table: CompensationTable, options: LinuxCncOptions) -> Mapping[str, str]:
        """Return the one file."""
        unit = table.axis.position_unit
        nominal = [round(unit.from_si(each), options.decimals) for each in table.positions.tolist()]
        if len(nominal) > _MOST_ROWS:
            raise InputError.at(
                table.place,
                f"LinuxCNC takes {_MOST_ROWS} rows, and this table has {len(nominal)}; state a longer step",
            )
        if len(nominal) < 2 or any(b <= a for a, b in pairwise(nominal)):
            raise InputError.at(
                table.place, "rows must rise in the digits that are written; state more decimals"
            )
        sign = 1 if options.type == 0 else -1
        rows = []
        for at, forward, reverse in zip(nominal, table.forward.tolist(), table.reverse.tolist(), strict=True):
            base = at if options.type == 0 else 0.0
            values = (at, base + sign * unit.from_si(forward), base + sign * unit.from_si(reverse))
            rows.append(
                " ".join(f"{round(each, options.decimals) + 0.0:.{options.decimals}f}" for each in values)
            )
        return {_END: "".join(f"{row}\n" for row in rows)}

    def read(
        self, files: Mapping[str, str], table: CompensationTable, options: LinuxCncOptions
    ) -> CompensationTable:
        """Return what LinuxCNC makes of the file, line by line as its parser does."""
        to_si = table.axis.position_unit.to_si
        rows: list[tuple[float, float, float]] = []
        for line in files[_END].splitlines():
            found = _ROW.match(line)
            if found is None:
                break
            nominal, forward, reverse = (float(each) for each in found.groups())
            if (rows and nominal <= rows[-1][0]) or len(rows) == _MOST_ROWS:
                continue
            base, sign = (nominal, 1) if options.type == 0 else (0.0, -1)
            rows.append((nominal, sign * (forward - base), sign * (reverse - base)))
        columns = np.array(rows).reshape(-1, 3).T
        grid, up, down = (read_only_floats([to_si(each) for each in column]) for column in columns)
        return replace(table, positions=grid, forward=up, reverse=down)


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return LinuxCNC."""
    return [LinuxCnc()]
