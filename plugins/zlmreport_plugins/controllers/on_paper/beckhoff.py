"""Beckhoff TwinCAT NC PTP: elements of structured text, by direction."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from zlmreport.plugin import Words, hookimpl
from zlmreport.plugin.controller import CompensationTable, Controller
from zlmreport_plugins.controllers.on_paper.formats import NO_TRIAL, NUMBER, OnPaper, decode, make_columns


class Beckhoff(OnPaper):
    """Beckhoff NC PTP: elements of ``ST_CompensationElement`` by direction, the correction −e in mm."""

    identifier = "beckhoff"
    title = Words("Beckhoff TwinCAT NC PTP")
    is_directional = True
    notes: tuple[Words, ...] = (NO_TRIAL,)

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:  # noqa: ARG002
        """Return the elements of each direction as structured text."""
        positions, forward, reverse = make_columns(table)
        return {
            end: "".join(
                f"(fPos := {at:.6f}, fCompensation := {0.0 - each:.6f}),\n"
                for at, each in zip(positions, values.tolist(), strict=True)
            )
            for end, values in (("-positive.st", forward), ("-negative.st", reverse))
        }

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:  # noqa: ARG002
        """Return the elements."""
        pattern = rf"fPos := {NUMBER}, fCompensation := {NUMBER}"
        forward, reverse = (re.findall(pattern, files[end]) for end in ("-positive.st", "-negative.st"))
        return decode(
            table,
            [float(at) for at, _ in forward],
            [-float(each) for _, each in forward],
            [-float(each) for _, each in reverse],
        )


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the control."""
    return [Beckhoff()]
