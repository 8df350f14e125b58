"""A table in the words of a control, with the forecast of that very table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol

from zlmreport.compensation.basis import Basis
from zlmreport.compensation.curve import CompensationTable, table_of
from zlmreport.compensation.forecast import Forecast, forecast
from zlmreport.errors import Place
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.arrays import FloatArray, read_only_floats


class TableWriter(Protocol):
    """What making a table needs of a control (`zlmreport.plugin.Controller`)."""

    identifier: str
    title: Words
    confidence: str
    notes: tuple[Words, ...]

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return its files."""

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return what the control makes of them."""


@dataclass(frozen=True, slots=True)
class Made:
    """A table, with all that it was made from and into.

    Attributes
    ----------
    controller
        The control.
    basis
        What is known of the axis.
    meant, decoded
        The table, and what the control makes of its files.
    active
        The table that was active during the test, and is replaced; None for none.
    files
        Texts by the ends of their names.
    forecast
        What the table leaves.
    """

    controller: TableWriter
    basis: Basis
    meant: CompensationTable
    decoded: CompensationTable
    active: CompensationTable | None
    files: Mapping[str, str]
    forecast: Forecast


def make(  # noqa: PLR0913, PLR0917 - of what, on which rows, for whom
    basis: Basis, rows: FloatArray, axis: Axis, number: str, place: Place, controller: TableWriter, own: Any
) -> Made:
    """Make a table.

    Parameters
    ----------
    basis
        What is known of the axis.
    rows : (g,) array
        Where it has its rows, m or rad.
    axis, number, place
        The axis with the table that was active; the name of the job; where the table is asked for.
    controller, own
        The control, and its keys.

    Raises
    ------
    InputError
        If the control would refuse the table, or cut it off.
    """
    meant = table_of(basis.wanted(rows), rows, axis, number, place)
    files = controller.files(meant, own)
    decoded = controller.read(files, meant, own)
    old = axis.compensation_table
    active = None
    if old is not None:
        active = replace(
            meant,
            positions=read_only_floats(old.positions),
            forward=read_only_floats(old.values),
            reverse=read_only_floats(old.reverse or old.values),
        )
    return Made(controller, basis, meant, decoded, active, files, forecast(basis, meant, decoded, active))
