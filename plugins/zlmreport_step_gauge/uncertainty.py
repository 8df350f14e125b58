"""Contributions of a step gauge to the uncertainty: faces, radius, touches, direction, expansion.

Every contribution but the faces is zero where nothing is stated or determined, and is then left out.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from zlmreport.plugin import (
    MICROMETRE,
    MICROMETRE_PER_METRE_KELVIN,
    MICRORADIAN,
    Approach,
    FloatArray,
    MeasurementSet,
    Words,
)
from zlmreport.plugin.extension import (
    STATED_COVERAGE_FACTOR,
    STATED_IN_THE_JOB,
    USUAL_CONTRIBUTIONS,
    Acts,
    Contribution,
    Distribution,
    calibration_in_words,
)
from zlmreport.plugin.standard import position_statistics
from zlmreport_step_gauge.deviations import compute_radius_uncertainty
from zlmreport_step_gauge.gauge import StepGauge
from zlmreport_step_gauge.set_up import GaugeSetUp, round_to_two_digits

_FACES = Words("Calibration of the faces")
_OF_FACES = Words("U = {low} µm to {high} µm (k = {factor})")
_RADIUS = Words("Effective radius of the probe")
_RADIUS_SOURCE = Words("acts by 2u; scatter of the mean of the blocks, without the machine's reversal")
_REFERENCE = Words("Reference face")
_STANDARD = Words("u = {value} {unit}")
_EXPANSION_SOURCE = Words("L·ΔT·u(α), ΔT = {difference} K; calibration of the gauge")


def list_gauge_contributions(
    set_up: GaugeSetUp, measurements: MeasurementSet, *, expansion_is_stated: bool = False
) -> tuple[Contribution, ...]:
    """Return the contributions of a step gauge.

    `set_up`: The gauge, its location, the probe, the temperatures.
    `measurements`: The readings: their number, and what the blocks scatter by.
    `expansion_is_stated`: Whether the budget has the uncertainty of the gauge's expansion coefficient from
        elsewhere.
    """
    targets = measurements.target_positions
    length = float(targets[-1] - targets[0])
    return (
        *_list_of_faces(set_up.gauge),
        *_list_of_reference(set_up, measurements),
        *_list_of_radius(set_up, measurements),
        *_list_of_touches(set_up),
        *_list_of_direction(set_up, length),
        *(() if expansion_is_stated else _list_of_expansion(set_up, length)),
    )


def part_uncertainty(distance: FloatArray, uncertainty: FloatArray) -> tuple[float, float]:
    """Return u at each face by itself, and u along the length, that together are nowhere less than stated.

    `distance`, (face,): From the first face, as a part of the whole length: 0 to 1.
    `uncertainty`, (face,): Standard uncertainty of each face, m.

    With u_L along the length and u_P at each position, u² = u_P² + u_L²·l². It is the stated one at the last
    face, and u_L is as large as leaves u at every other face no smaller than the stated one there.
    """
    last = float(uncertainty[-1]) ** 2
    before = distance < 1
    possible = (last - uncertainty[before] ** 2) / (1 - distance[before] ** 2)
    along = max(0.0, min(float(possible.min()), last))
    at_each = max(last - along, float(np.max(uncertainty**2 - along * distance**2)))
    return math.sqrt(at_each), math.sqrt(along)


def _list_of_faces(gauge: StepGauge) -> Iterator[Contribution]:
    nominal = np.array([face.nominal for face in gauge.faces])
    expanded = np.array([face.expanded_uncertainty for face in gauge.faces])
    distance = (nominal - nominal[0]) / (nominal[-1] - nominal[0])
    at_each, along = part_uncertainty(distance, expanded / STATED_COVERAGE_FACTOR)
    stated = _OF_FACES.given(
        low=MICROMETRE.from_si(float(expanded.min())),
        high=MICROMETRE.from_si(float(expanded.max())),
        factor=STATED_COVERAGE_FACTOR,
    )
    source = calibration_in_words(gauge.certificate)
    for name, size, acts in (
        (Words("Calibration of the faces, part that grows with the length"), along, Acts.ALONG_THE_LENGTH),
        (_FACES, at_each, Acts.AT_EACH_APPROACH),
    ):
        if size:
            yield Contribution(name, size, acts, Distribution.NORMAL, stated, source)


def _list_of_reference(set_up: GaugeSetUp, measurements: MeasurementSet) -> Iterator[Contribution]:
    """Yield u of the face that all deviations are relative to: its calibration, and its touches.

    A face whose distance is zero is the one that the gauge's calibration is relative to, and is exact.
    """
    is_front = Approach.POSITIVE in measurements.approaches
    first = set_up.gauge.faces[0 if is_front else 1]
    of_face = first.expanded_uncertainty / STATED_COVERAGE_FACTOR if first.distance else 0.0
    touches = max(1, int(np.count_nonzero(np.isfinite(measurements.deviations()[:, 0]))))
    size = math.hypot(of_face, set_up.probing_uncertainty / math.sqrt(touches))
    if size:
        yield Contribution(
            _REFERENCE,
            size,
            Acts.AT_THE_DATUM,
            Distribution.NORMAL,
            _compute_standard(size),
            Words("its calibration and its touches"),
        )


def _list_of_touches(set_up: GaugeSetUp) -> Iterator[Contribution]:
    size = set_up.probing_uncertainty
    if size:
        yield Contribution(
            Words("Repeatability of the probe"),
            size,
            Acts.AT_EACH_READING,
            Distribution.NORMAL,
            _compute_standard(size),
            STATED_IN_THE_JOB,
        )


def _list_of_radius(set_up: GaugeSetUp, measurements: MeasurementSet) -> Iterator[Contribution]:
    """Yield 2·u(R_eff), by which the back faces lie off the front faces, among which the reference face is.

    u(R_eff) is as stated, or by the scatter of the blocks about their mean: their radii scatter by half of
    what the differences between the directions scatter by.
    """
    if set_up.radius_is_corrected or not measurements.is_bidirectional:
        return
    stated = set_up.effective_radius
    size = stated.uncertainty if stated else _estimate_by_scatter(set_up, measurements)
    source = STATED_IN_THE_JOB if stated else _RADIUS_SOURCE
    if size:
        yield Contribution(
            _RADIUS, 2 * size, Acts.BETWEEN_DIRECTIONS, Distribution.NORMAL, _compute_standard(size), source
        )


def _estimate_by_scatter(set_up: GaugeSetUp, measurements: MeasurementSet) -> float:
    statistics = position_statistics(measurements.deviations())
    forward = statistics.mean_positive[np.isfinite(statistics.mean_positive)]
    backward = statistics.mean_negative[np.isfinite(statistics.mean_negative)]
    number = min(len(forward), len(backward))
    return compute_radius_uncertainty((backward[:number] - forward[:number]) / 2, set_up.gauge.faces)


def _list_of_direction(set_up: GaugeSetUp, length: float) -> Iterator[Contribution]:
    """Yield the cosine error of a direction that is uncertain by u both ways across.

    θ² is then u²·χ² with two degrees of freedom, so that the error L·θ²/2 has the root mean square √2·L·u².
    """
    if set_up.located is None:
        return
    uncertainty = set_up.located.location.direction_uncertainty
    yield Contribution(
        USUAL_CONTRIBUTIONS["misalignment"],
        math.sqrt(2) * length * uncertainty**2,
        Acts.ALONG_THE_LENGTH,
        Distribution.ONE_SIDED,
        _STANDARD.given(value=round_to_two_digits(MICRORADIAN.from_si(uncertainty)), unit="µrad"),
        Words("cosine error L·θ²/2 of the direction C1C2, from the initial points"),
        "misalignment",
    )


def _list_of_expansion(set_up: GaugeSetUp, length: float) -> Iterator[Contribution]:
    """Yield u(α) of the gauge where its expansion is compensated."""
    expansion, known = set_up.gauge_expansion, set_up.gauge.expansion_uncertainty
    if expansion is None or not known:
        return
    yield Contribution(
        USUAL_CONTRIBUTIONS["device_expansion_coefficient"],
        length * abs(expansion.difference) * known,
        Acts.ALONG_THE_LENGTH,
        Distribution.NORMAL,
        Words("u(α) = {value} µm/(m·K)").given(value=known / MICROMETRE_PER_METRE_KELVIN),
        _EXPANSION_SOURCE.given(difference=float(round(expansion.difference, 4))),
        "device_expansion_coefficient",
    )


def _compute_standard(value: float) -> Words:
    return _STANDARD.given(value=round_to_two_digits(MICROMETRE.from_si(value)), unit="µm")
