"""ISO 230-4:2005, circular tests: circular and radial deviations of the paths of a circle in both senses.

Of the standard itself its preview pages were read: that G(b) of this edition replaced the circular
hysteresis, that it holds no set-up error and needs no calibrated length, and that a nominal path is an arc of
90° at least. The rest is this program's reading.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    CIRCLE,
    MILLIMETRE,
    Approach,
    BoolArray,
    CircleKeys,
    Evaluation,
    Figure,
    FloatArray,
    IntArray,
    MeasurementSet,
    Options,
    Words,
    hookimpl,
)
from zlmreport.plugin.standard import (
    Arithmetic,
    Basis,
    Finding,
    Information,
    PositionQuantity,
    PositionStatistics,
    Standard,
    deviation_in_words,
    no_missing_readings,
    position_in_words,
)
from zlmreport_plugins.standards.iso230_4 import figures
from zlmreport_plugins.standards.iso230_4.circles import (
    Zone,
    compute_about,
    find_minimum_zone,
    find_zone_about,
    fit_least_squares_circle,
    is_full_turn,
    measure_covered_arc,
)
from zlmreport_plugins.standards.iso230_4.quantities import NOTES, QUANTITIES, SENSES

#: Of a nominal path, rad.
_LEAST_ARC = math.pi / 2
#: What a centre that lies off may leave in the form of a circle, m.
_OFF_CENTRE = 1e-7


class Iso230Part4Options(Options):
    """The job keys of ISO 230-4."""

    of_the_measurement = ("circle",)

    reference_circle: Literal["minimum-zone", "least-squares"] = Field(
        "minimum-zone",
        description="About which centre G is taken: that of the two circles that are nearest to each other, "
        "or of the circle of least squares, which the standard allows too.",
    )
    circle: CircleKeys | None = Field(None, description="The circle that was run; as the job states it.")

    @property
    def has_length(self) -> bool:
        """Whether the instrument's length is known: F and D are defined only then."""
        return self.circle is not None and self.circle.calibrated_length


def find_zone_of(points: FloatArray, angles: FloatArray, options: Iso230Part4Options) -> Zone:
    """Return the two circles about one centre that hold points, (..., n), between them."""
    if options.reference_circle == "minimum-zone":
        return find_minimum_zone(points, angles)
    return find_zone_about(fit_least_squares_circle(points, angles).centre, points, angles)


def compute_parameters(
    mean: FloatArray, angles: FloatArray, options: Iso230Part4Options
) -> dict[str, FloatArray]:
    """Return the parameters by symbol, m, each of shape (...).

    `mean`, (..., approach, m): The mean path of each sense; NaN where a sense was not run, or not there.
    """
    batch, tests = mean.shape[:-2], mean.reshape(-1, *mean.shape[-2:])
    found = {each.symbol: np.full(len(tests), np.nan) for each in QUANTITIES}
    for alike, there in _group_alike(np.isfinite(tests)) if np.isfinite(angles).all() else ():
        for symbol, values in _compute_of_paths(tests[alike], there, angles, options).items():
            found[symbol][alike] = values
    return {symbol: values.reshape(batch) for symbol, values in found.items()}


def _group_alike(there: BoolArray) -> Iterator[tuple[IntArray, BoolArray]]:
    """Yield the indices of tests in which the same points are there, and which: mostly of all tests."""
    if (there == there[:1]).all():
        yield np.arange(len(there)), there[0]
        return
    patterns, which = np.unique(there.reshape(len(there), -1), axis=0, return_inverse=True)
    for number, pattern in enumerate(patterns):
        yield np.flatnonzero(which == number), pattern.reshape(there.shape[1:])


def _compute_of_paths(
    mean: FloatArray, there: BoolArray, angles: FloatArray, options: Iso230Part4Options
) -> dict[str, FloatArray]:
    """Return the parameters that tests define in which the same points are there: (test,)."""
    is_full = is_full_turn(angles[there.any(axis=0)])
    found = {}
    for sense, path, present in zip(SENSES, np.moveaxis(mean, 1, 0), there, strict=True):
        points, at = path[:, present], angles[present]
        if not at.size:
            continue
        found[f"G_{sense}"] = find_zone_of(points, at, options).width
        if options.has_length:
            radial = (
                compute_about(fit_least_squares_circle(points, at).centre, points, at) if is_full else points
            )
            found[f"F_max_{sense}"], found[f"F_min_{sense}"] = radial.max(axis=-1), radial.min(axis=-1)
    if there.any(axis=1).all():
        points, at = mean[:, there], np.broadcast_to(angles, there.shape)[there]
        found["G_b"] = find_zone_of(points, at, options).width
        if is_full and options.has_length:
            found["D"] = fit_least_squares_circle(points, at).radius
    return found


def check_requirements(measurements: MeasurementSet, options: Iso230Part4Options) -> Iterator[Finding]:
    """Yield the requirements, held against the test."""
    yield _check_both_senses(measurements)
    yield _check_arc(measurements)
    yield _check_calibrated(options)
    yield from _check_centred(measurements, options)
    yield no_missing_readings(measurements)
    yield from _check_averaged(measurements)


def _check_both_senses(measurements: MeasurementSet) -> Finding:
    requirement = Words("Paths in both senses, counter-clockwise and clockwise")
    there = np.isfinite(measurements.deviation)
    senses = [
        words
        for approach, words in zip(Approach, measurements.axis.measurand.senses, strict=True)
        if np.any(measurements.approach[there] == approach)
    ]
    if len(senses) > 1:
        return Finding(requirement, Words("both senses"), met=True)
    if not senses:
        return Finding(requirement, Words("no reading at all"), met=False)
    found = Words(
        "{sense} only: G of this sense; G(b) and D need both senses, and what changes with the sense, as a "
        "lag of one axis, is not told from what does not"
    )
    return Finding(requirement, found.given(sense=senses[0]), met=False)


def _check_arc(measurements: MeasurementSet) -> Finding:
    """Ask for an arc of 90° at least; say what an arc below a full turn cannot give."""
    arc = measure_covered_arc(measurements.target_positions)
    requirement = Words("Nominal path of at least {arc}").given(
        arc=position_in_words(measurements.axis, _LEAST_ARC)
    )
    if is_full_turn(measurements.target_positions):
        return Finding(requirement, Words("a full turn"), met=True, basis=Basis.PUBLISHED)
    found = Words(
        "an arc of {arc}; the centre is then weakly known, F is taken about that of the set-up, and D is not "
        "reported"
    ).given(arc=position_in_words(measurements.axis, round(arc, 3)))
    return Finding(requirement, found, arc >= _LEAST_ARC, Basis.PUBLISHED)


def _check_calibrated(options: Iso230Part4Options) -> Finding:
    """Say whether F and D are defined."""
    requirement = Words("A calibrated length of the instrument, for F and D")
    if options.has_length:
        return Finding(requirement, Words("stated"), met=True)
    found = Words("not stated (circle.calibrated_length); F and D are not reported")
    return Finding(requirement, found, met=None)


def _check_centred(measurements: MeasurementSet, options: Iso230Part4Options) -> Iterator[Finding]:
    """Ask that the instrument stands so near the centre that its offset is a shift and no error of form."""
    there = np.isfinite(measurements.deviation)
    angles = measurements.target_positions
    if options.circle is None or not there.any() or not is_full_turn(angles):
        return
    centre = fit_least_squares_circle(
        measurements.deviation[there], angles[measurements.target[there]]
    ).centre
    offset = float(np.hypot(*centre))
    left = offset**2 / (2 * MILLIMETRE.to_si(options.circle.radius))
    axis = measurements.axis
    requirement = Words(
        "Instrument so near to the centre of the circle that e²/(2R) is {most} at most"
    ).given(most=deviation_in_words(axis, _OFF_CENTRE))
    found = Words("e = {offset}: {left}").given(
        offset=deviation_in_words(axis, float(f"{offset:.3g}")),
        left=deviation_in_words(axis, float(f"{left:.2g}")),
    )
    yield Finding(requirement, found, left <= _OFF_CENTRE)


def _check_averaged(measurements: MeasurementSet) -> Iterator[Finding]:
    """Say what was averaged out of readings that are many to an angle, as a vibration of the machine."""
    averaging = measurements.provenance.averaging
    if averaging is None:
        return
    axis = measurements.axis
    requirement = Words("No vibration of the machine hidden by averages of readings")
    left_out = deviation_in_words(axis, float(f"{averaging.left_out:.2g}"))
    if not averaging.amplitude:
        found = Words(
            "left out of the averages: {left_out} (root mean square), with no vibration that stands out"
        )
        yield Finding(requirement, found.given(left_out=left_out), met=True)
        return
    found = Words(
        "left out of the averages: {left_out} (root mean square); in it {frequency} Hz with an amplitude of "
        "{amplitude}, which G does not hold"
    ).given(
        left_out=left_out,
        frequency=float(f"{averaging.frequency:.3g}"),
        amplitude=deviation_in_words(axis, float(f"{averaging.amplitude:.2g}")),
    )
    yield Finding(requirement, found, met=False)


class Iso230Part4:
    """ISO 230-4 in the edition of 2005."""

    identifier = "iso230-4:2005"
    designation = "ISO 230-4:2005"
    title = Words("Circular tests for numerically controlled machine tools")
    position_index = "i"
    options: type[Options] = Iso230Part4Options
    measurands = (CIRCLE,)
    information = (
        Information.PATH,
        Information.COMPENSATION,
        Information.TEMPERATURES,
        Information.INSTRUMENT,
    )
    quantities = QUANTITIES
    position_quantities: tuple[PositionQuantity, ...] = ()
    notes = NOTES

    def requirements(self, measurements: MeasurementSet, options: Iso230Part4Options) -> Iterable[Finding]:
        """Hold the requirements against the test."""
        return check_requirements(measurements, options)

    def arithmetic(self, statistics: PositionStatistics, options: Iso230Part4Options) -> Arithmetic:
        """Return the parameters of the mean path of each sense."""
        return Arithmetic(compute_parameters(statistics.mean, statistics.positions, options))

    def figures(self, evaluation: Evaluation, options: Iso230Part4Options) -> Iterable[Figure]:
        """Return the paths about the nominal circle, and over the angle."""
        return figures.draw_figures(evaluation, find_zone_of, options)


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the edition of 2005."""
    return (Iso230Part4(),)
