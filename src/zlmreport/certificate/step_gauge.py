"""The step gauge of a test: which section of it was used, where it lay, and its calibration."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate.circumstances import Fact
from zlmreport.certificate.document import Graph
from zlmreport.figures.gauge_calibration import gauge_calibration
from zlmreport.language import Words
from zlmreport.quantities.formatting import fixed_number
from zlmreport.quantities.units import MICRORADIAN, MILLIMETRE
from zlmreport.step_gauge.set_up import gauge_set_up

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.presenting.writer import Writer
    from zlmreport.step_gauge.location import Located

_SECTION = Words(en="blocks {first} to {last}", de="Blöcke {first} bis {last}")


def facts(job: Job, writer: Writer) -> Iterator[Fact]:
    """Yield the section of the gauge that was used, and where it lay; nothing for another instrument."""
    set_up = gauge_set_up(job)
    if set_up is None:
        return
    numbers = set_up.gauge.blocks
    yield Fact(
        Words(en="Section used", de="Benutzter Abschnitt"),
        writer.say(_SECTION.given(first=numbers[0], last=numbers[-1])),
        ("step_gauge.first_block", "step_gauge.last_block"),
    )
    if set_up.located:
        yield from _location(set_up.located, writer)


def graph(job: Job) -> Iterator[Graph]:
    """Yield the graph of the gauge's calibration; nothing for another instrument."""
    set_up = gauge_set_up(job)
    if set_up:
        yield Graph(gauge_calibration(set_up.gauge))


def _location(located: Located, writer: Writer) -> Iterator[Fact]:
    key = ("step_gauge.initial_points",)
    location = located.location
    yield Fact(Words(en="Begins at C1", de="Beginnt bei C1"), _point(location.begin, writer), key)
    yield Fact(Words(en="Ends at C2", de="Endet bei C2"), _point(location.end, writer), key)
    yield Fact(
        Words(en="Direction C1C2", de="Richtung C1C2"),
        f"u = {_two_digits(MICRORADIAN.from_si(location.direction_uncertainty), writer)} µrad",
        key,
    )


def _point(coordinates: tuple[float, float, float], writer: Writer) -> str:
    """Write coordinates to a micrometre: x / y / z."""
    sign = writer.language.decimal_sign
    return " / ".join(fixed_number(MILLIMETRE.from_si(each), 3, sign) for each in coordinates) + " mm"


def _two_digits(value: float, writer: Writer) -> str:
    return writer.number(float(f"{value:.2g}"))
