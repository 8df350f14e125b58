"""HEIDENHAIN: a ``.COM`` table, and the line of the ``.CMA`` file that gives it to the axis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import Options, Words, hookimpl
from zlmreport.plugin.controller import CompensationTable, Controller
from zlmreport_plugins.controllers.on_paper.formats import (
    NO_TRIAL,
    NamedAxisOptions,
    OnPaper,
    decode,
    join_lines,
    make_columns,
    name_axis,
    refuse_more_than,
)


class HeidenhainOptions(NamedAxisOptions):
    """The keys of ``heidenhain``."""

    backlash: Literal["reverse", "play"] | None = Field(
        None,
        description="What the control wants in BACKLASH: by how much the deviations moving back differ from "
        "those moving forward (play), or these themselves (reverse). Without it play, which the sheet says.",
    )


class Heidenhain(OnPaper):
    """HEIDENHAIN ``.COM`` and ``.CMA``: position, play and deviation forward, mm; which axis has which table.

    The columns are documented (NR, AXISPOS, BACKLASH, the axis; NR, ACTIVE, the axis): at most 256 rows,
    equally far apart, and of one control BACKLASH has what was measured in the negative direction (technical
    manual MANUALplus 620, 6.10). Of others it is not known, and neither head nor sign is confirmed.
    """

    identifier = "heidenhain"
    title = Words("HEIDENHAIN (.COM)")
    most_rows = 256
    is_directional = True
    is_equidistant = True
    options: type[Options] = HeidenhainOptions
    notes: tuple[Words, ...] = (
        NO_TRIAL,
        Words(
            "The .CMA file names this table for the axis alone: add its line to that of the control, "
            "which may name tables of other axes, and mark it active (*)."
        ),
    )

    def list_assumed(self, table: CompensationTable, options: Any) -> Iterator[Words]:
        """Yield what BACKLASH was taken for, where that makes a difference."""
        if options.backlash is None and np.any(table.forward != table.reverse):
            yield Words(
                "Taken for granted: the column BACKLASH has by how much the deviations moving back differ "
                "from those moving forward. The maker's manual of the MANUALplus 620 has the deviations "
                "moving back themselves there: state compensation.backlash, play or reverse."
            )

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the table, and the line that gives it to the axis."""
        refuse_more_than(self.most_rows, table)
        name = name_axis(table, options)
        assigned = ("BEGIN CONFIG .CMA", f"NR ACTIVE {name}", f"0  *      {table.number}.COM", "[END]")
        lines = [f"BEGIN {name}_AXIS .COM", f"NR AXISPOS  BACKLASH  {name}"]
        for row, (at, up, down) in enumerate(zip(*make_columns(table), strict=True)):
            back = float(down - (up if options.backlash != "reverse" else 0.0))
            lines.append(f"{row}     {at:+.4f}   {back + 0.0:+.4f}   {float(up) + 0.0:+.4f}")
        return {".COM": join_lines((*lines, "[END]")), ".CMA": join_lines(assigned)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return the rows."""
        rows = [[float(each) for each in line.split()] for line in files[".COM"].splitlines()[2:-1]]
        _, positions, back, forward = zip(*rows, strict=True)
        base = forward if options.backlash != "reverse" else (0.0,) * len(forward)
        return decode(table, positions, forward, [each + gap for each, gap in zip(base, back, strict=True)])


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the control."""
    return [Heidenhain()]
