"""ISG and TwinCAT CNC: ``kw.ssfk`` lists."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

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
)


class Isg(OnPaper):
    """ISG and TwinCAT CNC (TF5200): ``kw.ssfk`` lists, +e by direction in whole 0.1 µm."""

    identifier = "isg"
    title = Words("ISG, TwinCAT CNC (kw.ssfk)")
    confidence = "documented"
    is_directional = True
    options: type[Options] = NamedAxisOptions
    notes: tuple[Words, ...] = (NO_TRIAL,)

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the one file; set positions are in whole 0.1 µm (0.0001°), too."""
        positions, forward, reverse = make_columns(table)
        lines = [
            "kopf.achs_nr 1",
            f"kopf.log_achs_name {name_axis(table, options)}",
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
        return {".lis": join_lines(lines)}

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the table of the list."""
        found = (
            [int(each) / 1e4 for each in re.findall(rf"\]\.{name} (-?\d+)", files[".lis"])]
            for name in ("setpoint", "pos", "neg")
        )
        return decode(table, *found)


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the control."""
    return [Isg()]
