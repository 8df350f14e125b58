"""A CSV table with the deviations themselves, for a control whose tables somebody types in or converts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import pairwise

from pydantic import Field

from zlmreport.plugin import InputError, Options, Words, hookimpl, read_only_floats
from zlmreport.plugin.controller import CompensationTable, Controller

_END = "-compensation.csv"


class TableCsvOptions(Options):
    """The keys of ``csv``."""

    decimals: int = Field(3, ge=0, le=6, description="Digits after the decimal point of deviations, µm or ″.")


class TableCsv:
    """Position, forward and reverse deviation (actual − target), without a sign turned."""

    identifier = "csv"
    title = Words("CSV table of deviations")
    options: type[Options] = TableCsvOptions
    confidence = "verified"
    is_directional = True
    is_equidistant = False
    notes: tuple[Words, ...] = (
        Words(
            "Deviations are actual − target: whoever makes a table for a control of them turns the sign "
            "if it asks for corrections."
        ),
    )

    def files(self, table: CompensationTable, options: TableCsvOptions) -> Mapping[str, str]:
        """Return the one file."""
        position, deviation = table.axis.position_unit, table.axis.deviation_unit
        if any(b <= a for a, b in pairwise(table.positions.tolist())):
            raise InputError.at(table.place, "the rows of a table rise")
        lines = ["position,forward,reverse"]
        for at, *values in zip(
            table.positions.tolist(), table.forward.tolist(), table.reverse.tolist(), strict=True
        ):
            written = (
                f"{round(deviation.from_si(each), options.decimals) + 0.0:.{options.decimals}f}"
                for each in values
            )
            lines.append(",".join([f"{position.from_si(at):.9g}", *written]))
        return {_END: "".join(f"{line}\n" for line in lines)}

    def read(
        self,
        files: Mapping[str, str],
        table: CompensationTable,
        options: TableCsvOptions,  # noqa: ARG002 - decimals are in the file
    ) -> CompensationTable:
        """Return what stands in the file."""
        position, deviation = table.axis.position_unit.to_si, table.axis.deviation_unit.to_si
        rows = [[float(cell) for cell in line.split(",")] for line in files[_END].splitlines()[1:]]
        positions, forward, reverse = zip(*rows, strict=True)
        return replace(
            table,
            positions=read_only_floats([position(each) for each in positions]),
            forward=read_only_floats([deviation(each) for each in forward]),
            reverse=read_only_floats([deviation(each) for each in reverse]),
        )


@hookimpl
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the table."""
    return [TableCsv()]
