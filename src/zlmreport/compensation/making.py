"""A table in the words of a control, with the forecast of that very table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol

from zlmreport.compensation.basis import ROWS_A_PERIOD, Basis, Periodic
from zlmreport.compensation.curve import CompensationTable, table_of
from zlmreport.compensation.forecast import Forecast, forecast
from zlmreport.compensation.grid import Grid, grid_of
from zlmreport.errors import InputError, Place
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.arrays import read_only_floats
from zlmreport.uncertainty.budget import Budget


class TableWriter(Protocol):
    """What making a table needs of a control (`zlmreport.plugin.Controller`)."""

    identifier: str
    title: Words
    confidence: str
    is_equidistant: bool
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
    grid
        Where the table has its rows, and why.
    left_out
        Periodic effects that no row carries, each with the length of its shortest wave, m or rad.
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
    grid: Grid
    left_out: tuple[tuple[str, float], ...]
    meant: CompensationTable
    decoded: CompensationTable
    active: CompensationTable | None
    files: Mapping[str, str]
    forecast: Forecast


def make(  # noqa: PLR0913, PLR0917 - of what, on which grid, for whom
    basis: Basis,
    axis: Axis,
    number: str,
    place: Place,
    controller: TableWriter,
    own: Any,
    *,
    step: float | None = None,
    budget: Budget | None = None,
) -> Made:
    """Make a table.

    Parameters
    ----------
    basis
        What is known of the axis.
    axis, number, place
        The axis with the table that was active; the name of the job; where the table is asked for.
    controller, own
        The control, and its keys.
    step
        Distance of the rows, m or rad; None for the grid that `grid_of` chooses.
    budget
        Of the measuring set-up; None where nothing is known of it.

    Raises
    ------
    InputError
        If the control would refuse the table, or cut it off; if a wave is wanted that no row can follow.
    """
    most = getattr(controller, "most_rows", None)
    grid = grid_of(basis, place, step=step, is_equidistant=controller.is_equidistant, most_rows=most)
    rows, left_out = grid.rows, basis.left_out(grid.rows)
    if basis.periodic is Periodic.IN and left_out:
        unit = axis.position_unit
        wave = unit.from_si(min(left_out.values()))
        raise InputError.at(
            place,
            f"{', '.join(left_out)}: a wave of {wave:g} {unit.symbol} needs {ROWS_A_PERIOD} rows in each of "
            f"its periods; state --step {wave / ROWS_A_PERIOD:g} or less, or leave it out",
        )
    meant = table_of(basis.wanted(rows)(rows), rows, axis, number, place)
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
    return Made(
        controller,
        basis,
        grid,
        tuple(left_out.items()),
        meant,
        decoded,
        active,
        files,
        forecast(basis, meant, decoded, active, budget),
    )
