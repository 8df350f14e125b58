"""Etalon: the exchange format of grid points and deviations."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from zlmreport.plugin import Options, Words, hookimpl
from zlmreport.plugin.controller import CompensationTable, Controller
from zlmreport_plugins.controllers.on_paper.formats import (
    NamedAxisOptions,
    OnPaper,
    decode,
    join_lines,
    make_columns,
    name_axis,
    write_short,
)


class Etalon(OnPaper):
    """The exchange format of Etalon: grid points and deviations, mm."""

    identifier = "etalon"
    title = Words("Etalon exchange format")
    options: type[Options] = NamedAxisOptions

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file; its section is named by the axis: EXX for X."""
        positions, forward, reverse = make_columns(table)
        section = f"E{name_axis(table, options) * 2}"
        rows = [
            f"{write_short(at)} {each + 0.0:.6f}"
            for at, each in zip(positions, ((forward + reverse) / 2).tolist(), strict=True)
        ]
        return {
            "-etalon.txt": join_lines((f"[{section}]", "Gridpoints = {", *rows, f"}} // end of {section}"))
        }

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the grid points."""
        rows = [line.split() for line in files["-etalon.txt"].splitlines()[2:-1]]
        values = [float(each) for _, each in rows]
        return decode(table, [float(at) for at, _ in rows], values, values)


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the control."""
    return [Etalon()]
