"""Makes the measurement set of a step gauge, with the remarks and corrections that are printed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum

import numpy as np

from zlmreport.plugin import (
    MICROMETRE,
    MICROMETRE_PER_METRE_KELVIN,
    MICRORADIAN,
    MILLIMETRE,
    Approach,
    Axis,
    MeasurementSet,
    PartRow,
    Place,
    Words,
)
from zlmreport.plugin.source import Correction, Provenance, Reading, SourceFile, collect_readings
from zlmreport_step_gauge.deviations import Deviations, EffectiveRadius, RadiusSource
from zlmreport_step_gauge.gauge import Face, Side
from zlmreport_step_gauge.location import Misalignment
from zlmreport_step_gauge.probed import Probed
from zlmreport_step_gauge.set_up import Expansion, GaugeSetUp, round_to_two_digits

INDICATION = Words(
    "Sign: deviation = indicated − calibrated position, by how much the machine reads too much (error of "
    "indication; Pahk and Kim, Eq. 2 and 3). By how much the axis stands too far has the opposite sign."
)
POSITION = Words(
    "Sign: deviation = calibrated − indicated position, by how much the axis stands too far when it reads "
    "a position (actual − target), as the job states. The errors of Pahk and Kim have the opposite sign."
)
_DIRECTION = Words(
    "Direction: ↑ is a front face, touched by a probe that moves from the beginning of the gauge to its "
    "end; ↓ is a back face, touched the other way. It is the direction of probing, and not that in which the "
    "axis came to the position."
)
_LINE = Words(
    "Measuring line: C1C2, through the centres of the first and the last block (Pahk and Kim); all points "
    "were projected on it."
)
_NO_LOCATION = Words(
    "Measuring line: the line through the probed points of one side, for no initial points are stated; "
    "direction ({direction})."
)
_NUMBER = Words("{number}")
_DISTANCES = Words(
    "The file gives distances from the reference face: in which direction they were projected, and which "
    "radius was taken off, it does not tell."
)
_ASKEW = Words(
    "Misalignment: the normal of the face touched at the {which} of the gauge is {angle} µrad off the "
    "measuring line (standard uncertainty {uncertainty} µrad); {verdict}."
)
_BEGIN = Words("beginning")
_END = Words("end")
_SIGNIFICANT = Words("the scatter of the points does not explain it")
_INSIGNIFICANT = Words("the scatter of the points explains it")
_DETERMINED = Words(
    "Effective radius of the probe: {radius} mm, the mean of {number} blocks (Pahk and Kim, "
    "Eq. 1), which scatter by {scatter} µm; standard uncertainty of the mean {uncertainty} µm. It holds the "
    "mean error of the machine within a block and its mean reversal: reversal values are relative to it."
)
_STATED = Words(
    "Effective radius of the probe: {radius} mm, as stated; standard uncertainty {uncertainty} µm."
)
_OF_MACHINE = Words("Radius of the probe: corrected by the machine.")
_FACES = Words(
    "Each target position is a face of the gauge and is reached from one side only; what needs both "
    "directions at one position is not reported by standards that ask for it."
)
_BLOCKS = Words(
    "Each target position is the middle of a block: ↑ was read at its front face and ↓ at its back face, "
    "half a block before and behind it. What the error of the axis changes over a block is in the reversal "
    "values."
)
_NOT_COMPENSATED = Words(
    "Temperature: the expansion of gauge and scale was not compensated; deviations hold at the "
    "temperatures of the test."
)
_TEMPERATURE = Words("Thermal expansion")
_METHOD = Words("lengths of the {what} at the reference temperature, L·α·ΔT")
_OF_GAUGE = Words("gauge", context="genitive")
_OF_BOTH = Words("gauge and of the scale")
_GAUGE = Words("gauge")
_SCALE = Words("scale")


def list_remarks(deviations: Deviations, set_up: GaugeSetUp, *, targets_are_blocks: bool) -> Iterator[Words]:
    """Yield what a reader of the readings must know."""
    yield _DIRECTION
    yield from _say_line(deviations, set_up)
    yield _say_radius(deviations.radius)
    yield _BLOCKS if targets_are_blocks else _FACES
    if not set_up.gauge_expansion:
        yield _NOT_COMPENSATED


def _list_corrections(deviations: Deviations, set_up: GaugeSetUp) -> Iterator[Correction]:
    """Yield the compensation of temperatures, if there is one."""
    gauge, scale = set_up.gauge_expansion, set_up.scale_expansion
    if gauge is None:
        return
    inputs = _say_expansion(_GAUGE, gauge)
    if scale:
        inputs = Words("{gauge}; {scale}").given(gauge=inputs, scale=_say_expansion(_SCALE, scale))
    changed = deviations.compensated
    yield Correction(
        _TEMPERATURE,
        _METHOD.given(what=_OF_BOTH if scale else _OF_GAUGE),
        inputs,
        float(changed[np.argmax(np.abs(changed))]),
    )


def _say_expansion(which: Words, expansion: Expansion) -> Words:
    return Words("{which}: α = {alpha} µm/(m·K), ΔT = {difference} K").given(
        which=which,
        alpha=expansion.coefficient / MICROMETRE_PER_METRE_KELVIN,
        difference=float(round(expansion.difference, 4)),
    )


def _say_line(deviations: Deviations, set_up: GaugeSetUp) -> Iterator[Words]:
    if deviations.direction is None:
        yield _DISTANCES
        return
    if set_up.located is None:
        yield _NO_LOCATION.given(direction=_say_direction(deviations.direction))
        return
    yield _LINE
    for which, found in (
        (_BEGIN, set_up.located.begin_misalignment),
        (_END, set_up.located.end_misalignment),
    ):
        yield _say_misalignment(which, found)


def _say_direction(direction: tuple[float, float, float]) -> PartRow:
    return PartRow(tuple(_NUMBER.given(number=round(each, 6) + 0.0) for each in direction))


def _say_misalignment(which: Words, found: Misalignment) -> Words:
    return _ASKEW.given(
        which=which,
        angle=round_to_two_digits(MICRORADIAN.from_si(found.angle)),
        uncertainty=round_to_two_digits(MICRORADIAN.from_si(found.uncertainty)),
        verdict=_SIGNIFICANT if found.is_significant else _INSIGNIFICANT,
    )


def _say_radius(found: EffectiveRadius) -> Words:
    if found.source is RadiusSource.MACHINE:
        return _OF_MACHINE
    if found.source is RadiusSource.NOWHERE:
        return Words("Radius of the probe: all faces are touched from the same side, so that it cancels.")
    radius = float(round(MILLIMETRE.from_si(found.radius), 6))
    uncertainty = round_to_two_digits(MICROMETRE.from_si(found.uncertainty))
    if found.source is RadiusSource.STATED:
        return _STATED.given(radius=radius, uncertainty=uncertainty)
    return _DETERMINED.given(
        radius=radius,
        number=len(found.by_block),
        scatter=round_to_two_digits(MICROMETRE.from_si(found.scatter)),
        uncertainty=uncertainty,
    )


#: The condition that says which face was touched: +1 a front face, −1 a back face; effects of the error model
#: know it by this name.
FACE = "face"


class Targets(Enum):
    """What is a target position.

    FACES: each face where it is, so that a position has readings of one direction. BLOCKS: each block as a
    whole, its front face read in the positive direction and its back face in the negative one, as if both
    stood at the middle of the block.
    """

    FACES = "faces"
    BLOCKS = "blocks"


class Sign(Enum):
    """What a deviation is.

    INDICATION: indicated minus calibrated, by how much the machine reads too much (Eq. 2 and 3). POSITION:
    calibrated minus indicated, by how much the axis stands too far when it reads a position: actual minus
    target, as a test with a laser has it.
    """

    INDICATION = "indicated-calibrated"
    POSITION = "calibrated-indicated"

    @property
    def factor(self) -> int:
        """By what an error of indication is multiplied."""
        return 1 if self is Sign.INDICATION else -1


def make_measurement_set(  # noqa: PLR0913 - what a set is made of
    probed: Probed,
    deviations: Deviations,
    set_up: GaugeSetUp,
    axis: Axis,
    *,
    targets: Targets,
    sign: Sign = Sign.INDICATION,
    origin: float,
    source: str,
    files: tuple[SourceFile, ...],
    place: Place,
) -> MeasurementSet:
    """Return the readings of a test with a step gauge.

    `probed`, `deviations`: The points, and what they come to.
    `targets`: Whether faces or blocks are target positions.
    `origin`: Position on the axis of the reference face of the gauge, m.
    """
    face_index = {face.number: index for index, face in enumerate(probed.faces)}
    cycle_index = {cycle: index for index, cycle in enumerate(probed.cycles)}
    middles = _find_middles(probed.faces)

    def reading_of(face: Face, cycle: int, at: Place) -> Reading:
        nominal = middles[face.block] if targets is Targets.BLOCKS else face.nominal
        approach = Approach.POSITIVE if face.side is Side.FRONT else Approach.NEGATIVE
        error = float(deviations.values[face_index[face.number], cycle_index[cycle]])
        deviation = sign.factor * error
        return Reading(at, origin + nominal, approach, cycle, deviation, conditions={FACE: float(approach)})

    faces = {face.number: face for face in probed.faces}
    taken = {(point.face, point.cycle) for point in probed.points}
    readings = [reading_of(faces[point.face], point.cycle, point.place) for point in probed.points]
    readings += [
        reading_of(face, cycle, place)
        for cycle in probed.cycles
        for face in probed.faces
        if (face.number, cycle) not in taken
    ]
    provenance = Provenance(
        source,
        (*files, *set_up.files),
        (
            INDICATION if sign is Sign.INDICATION else POSITION,
            *list_remarks(deviations, set_up, targets_are_blocks=targets is Targets.BLOCKS),
        ),
        tuple(
            replace(each, largest=sign.factor * each.largest)
            for each in _list_corrections(deviations, set_up)
        ),
    )
    found = collect_readings(readings, axis, provenance, place=place)
    return replace(
        found,
        one_sided_targets=_is_one_sided(found),
        is_indication=sign is Sign.INDICATION,
        reversal_is_relative=found.is_bidirectional and deviations.radius.source is RadiusSource.BLOCKS,
    )


def _is_one_sided(measurements: MeasurementSet) -> bool:
    """Whether each target has readings of one direction, and both directions occur."""
    present = np.zeros((len(Approach), len(measurements.target_positions)), dtype=np.bool_)
    for approach in Approach:
        present[approach.index, measurements.target[measurements.approach == approach]] = True
    return bool(measurements.is_bidirectional and np.all(present.sum(axis=0) == 1))


def _find_middles(faces: tuple[Face, ...]) -> dict[int, float]:
    """Return the middle of each block, m."""
    by_block: dict[int, list[float]] = {}
    for face in faces:
        by_block.setdefault(face.block, []).append(face.nominal)
    return {block: sum(nominal) / len(nominal) for block, nominal in by_block.items()}
