"""Compensation tables for notebooks, with what they will leave."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from zlmreport.compensation.basis import basis_of_means
from zlmreport.compensation.curve import curve_of, rows_of
from zlmreport.compensation.making import Made, make
from zlmreport.errors import InputError, Place
from zlmreport.files import Document, demand_free, write
from zlmreport.notebook.readings import Readings, checked, registry
from zlmreport.notebook.table import Table, as_html

_PLACE = Place("compensate")


class Compensation:
    """A table in the words of a control: ``z.compensate(data, "linuxcnc").save("tables")``."""

    def __init__(self, data: Readings, made: Made, number: str) -> None:
        self.data = data
        self.controller = made.controller.identifier
        self.confidence = made.controller.confidence
        self.files = MappingProxyType({f"{number}{end}": text for end, text in made.files.items()})
        self._made = made

    @property
    def table(self) -> Table:
        """What is taken away at each position (mm or °): ``forward`` and ``reverse``, µm or ″."""
        axis, meant = self.data.measurements.axis, self._made.meant
        return Table(
            position=axis.position_unit.from_si(meant.positions),
            forward=axis.deviation_unit.from_si(meant.forward),
            reverse=axis.deviation_unit.from_si(meant.reverse),
        )

    @property
    def before(self) -> dict[str, float]:
        """E, M, B and A of the mean deviations as they are, µm or ″."""
        return self._made.forecast.before.in_unit(self._factor)

    @property
    def after(self) -> dict[str, float]:
        """The same as they are expected with the table; a forecast is no measurement."""
        return self._made.forecast.after.in_unit(self._factor)

    @property
    def between(self) -> float:
        """The largest deviation that is expected anywhere between the rows, µm or ″."""
        return self._made.forecast.between * self._factor

    @property
    def _factor(self) -> float:
        return self.data.measurements.axis.deviation_unit.from_si(1.0)

    def save(self, folder: str | Path) -> Path:
        """Write the files of the control; no file that is there already is touched.

        Raises
        ------
        AccessError
            If they cannot be written, or are there.
        """
        documents = [Document(Path(folder) / name, text.encode()) for name, text in self.files.items()]
        demand_free(document.path for document in documents)
        write(documents)
        return Path(folder)

    def __repr__(self) -> str:
        """Return the control, and E before and after."""
        before, after = self.before["E"], self.after["E"]
        return f"<compensation for {self.controller} ({self.confidence}): E {before:.3g} → {after:.3g}>"

    def _repr_html_(self) -> str:
        return as_html(
            ("", "before", "after"),
            [(name, before, self.after[name]) for name, before in self.before.items()],
        )


def compensate(  # noqa: PLR0913 - each by its name
    data: Readings,
    controller: str,
    *,
    active: Literal["none", "of the axis"],
    number: str = "compensation",
    step: float | None = None,
    unconfirmed: bool = False,
    **keys: Any,
) -> Compensation:
    """Make a compensation table from the mean deviations.

    Parameters
    ----------
    data
        The readings of a test.
    controller
        Of which control: ``linuxcnc``, ``csv``.
    active
        Which table was active during the test: ``none``, or the one ``of the axis``, which it then replaces
        (``z.read(…, axis={"compensation_table": …})``). A new table on top of one that nobody knows corrects
        twice.
    number
        The stem of the names of the files.
    step
        Between rows, mm or °; the targets without it.
    unconfirmed
        Whether a format that was never tried on the control is written.
    **keys
        Further keys of the controller as in a job: ``type=0``.

    Raises
    ------
    InputError
        If there is no such controller, or it cannot take the table.
    """
    axis = data.measurements.axis
    if (active == "none") != (axis.compensation_table is None):
        known = "no" if axis.compensation_table is None else "a"
        raise InputError.at(_PLACE, f"active is {active!r}, and the axis of these readings has {known} table")
    writer = registry().controller(controller, _PLACE)
    if writer.confidence != "verified" and not unconfirmed:
        raise InputError.at(
            _PLACE,
            f"the format of {controller} is {writer.confidence}, and was never tried on the control; "
            "unconfirmed=True writes it all the same: try it with care, one point first",
        )
    options = checked(writer.options, keys, "compensate")
    curve = curve_of(data.measurements, _PLACE)
    rows = rows_of(
        curve,
        _PLACE,
        step=None if step is None else axis.position_unit.to_si(step),
        is_equidistant=writer.is_equidistant,
    )
    basis = basis_of_means(curve, data.measurements, None)
    return Compensation(data, make(basis, rows, axis, number, _PLACE, writer, options), number)
