"""ISO 230-3, thermal effects: the test of the environment, how far a machine drifts while it stands.

Of the standard itself previews of its edition of 2020 were read: that it has four tests, of which this is the
environmental temperature variation error. That it is not made for comparing machines is published in a part
for turning centres. The formulas, the sensors and the least time of a test are this program's reading. The
other three tests, of a turning spindle, of moving axes and of rotary components, are not here.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    MILLIMETRE,
    Evaluation,
    Figure,
    JobPart,
    MeasurementSet,
    NotNegative,
    Options,
    Positive,
    Words,
    hookimpl,
)
from zlmreport.plugin.standard import (
    Arithmetic,
    Finding,
    Information,
    PositionQuantity,
    PositionStatistics,
    Standard,
)
from zlmreport_plugins.standards.iso230_3 import figures, requirements
from zlmreport_plugins.standards.iso230_3.hours import Hours, compute_span_in, compute_tilt_in
from zlmreport_plugins.standards.iso230_3.quantities import DRIFT, NAMES, NOTES, PAIRS, QUANTITIES


class DistanceKeys(JobPart):
    """How far both sensors of a direction are apart."""

    X: Positive | None = Field(None, description="Of X1 and X2, mm.", examples=[200])
    Y: Positive | None = Field(None, description="Of Y1 and Y2, mm.", examples=[200])
    Z: Positive | None = Field(None, description="Of Z1 and Z2, mm.", examples=[200])


class Iso230Part3Options(Options):
    """The hours of the drift, and the distances of the sensors."""

    hours: Positive | None = Field(
        None,
        description="Over how many hours the drift is taken; without it over the whole record.",
        examples=[24],
    )
    start: NotNegative = Field(
        0.0, description="From which hour on, counted from the first reading of the file.", examples=[1]
    )
    distance: DistanceKeys = Field(
        DistanceKeys(),
        description="How far both sensors of a direction are apart: their tilt follows from it.",
        examples=[{"X": 200, "Y": 200}],
    )

    @property
    def time(self) -> Hours:
        """The hours in seconds."""
        return Hours.of(self.start, self.hours)

    @property
    def distances(self) -> dict[str, float]:
        """The stated distances, m, by the letter of their direction."""
        stated = {letter: getattr(self.distance, letter) for letter in PAIRS}
        return {letter: MILLIMETRE.to_si(each) for letter, each in stated.items() if each is not None}


class Iso230Part3:
    """The test of the environment by ISO 230-3."""

    identifier = "iso230-3"
    designation = "ISO 230-3"
    title = Words("Thermal effects: environmental temperature variation error")
    position_index = "i"
    options: type[Options] = Iso230Part3Options
    measurands = (DRIFT,)
    information = (Information.COMPENSATION, Information.TEMPERATURES, Information.INSTRUMENT)
    quantities = QUANTITIES
    position_quantities: tuple[PositionQuantity, ...] = ()
    notes = NOTES

    def requirements(self, measurements: MeasurementSet, options: Iso230Part3Options) -> Iterable[Finding]:
        """Hold the plan of the test against the sensors' records."""
        return requirements.check_requirements(measurements, options.time, options.distances)

    def arithmetic(self, statistics: PositionStatistics, options: Iso230Part3Options) -> Arithmetic:
        """Return the range of each sensor that was read, and of the tilt of each two, in the hours."""
        batch, lines = statistics.mean.shape[:-2], statistics.tests
        found = {each.symbol: np.full(batch, np.nan) for each in QUANTITIES}
        for name in (each for each in NAMES if each in lines):
            found[f"E_{name}"] = compute_span_in(lines[name], options.time)
        for letter, distance in options.distances.items():
            first, second = PAIRS[letter]
            if first in lines and second in lines:
                found[f"tilt_{letter}"] = compute_tilt_in(lines[first], lines[second], distance, options.time)
        return Arithmetic(found)

    def figures(self, evaluation: Evaluation, options: Iso230Part3Options) -> Iterable[Figure]:
        """Return the displacements, tilts and temperatures over one axis of time."""
        return figures.draw_figures(evaluation, options.time, options.distances)


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Offer the test of the environment."""
    return (Iso230Part3(),)
