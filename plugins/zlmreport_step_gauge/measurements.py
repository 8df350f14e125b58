"""From the deviations at the faces of a gauge to a measurement set that any standard evaluates."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

import numpy as np

from zlmreport.plugin import (
    Approach,
    Axis,
    MeasurementSet,
    Place,
    Provenance,
    Reading,
    SourceFile,
    collect_readings,
)
from zlmreport_step_gauge import remarks
from zlmreport_step_gauge.deviations import Deviations, RadiusSource
from zlmreport_step_gauge.gauge import Face, Side
from zlmreport_step_gauge.probed import Probed
from zlmreport_step_gauge.set_up import GaugeSetUp

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


def measurement_set(  # noqa: PLR0913 - what a set is made of
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

    Parameters
    ----------
    probed, deviations
        The points, and what they come to.
    set_up
        The gauge and its location.
    axis
        The axis, or line, under test.
    targets
        Whether faces or blocks are target positions.
    sign
        What a deviation is.
    origin
        Position on the axis of the reference face of the gauge, m.
    source
        Identifier of the data source.
    files
        The files of the points.
    place
        The file of the points, for messages.
    """
    face_index = {face.number: index for index, face in enumerate(probed.faces)}
    cycle_index = {cycle: index for index, cycle in enumerate(probed.cycles)}
    middles = _middles(probed.faces)

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
            remarks.INDICATION if sign is Sign.INDICATION else remarks.POSITION,
            *remarks.remarks(deviations, set_up, targets_are_blocks=targets is Targets.BLOCKS),
        ),
        tuple(
            replace(each, largest=sign.factor * each.largest)
            for each in remarks.corrections(deviations, set_up)
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


def _middles(faces: tuple[Face, ...]) -> dict[int, float]:
    """Return the middle of each block, m."""
    by_block: dict[int, list[float]] = {}
    for face in faces:
        by_block.setdefault(face.block, []).append(face.nominal)
    return {block: sum(nominal) / len(nominal) for block, nominal in by_block.items()}
