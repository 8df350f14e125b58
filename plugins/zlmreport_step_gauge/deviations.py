"""Computes deviations from probed points: projection, effective radius, temperature, Equations 1 to 3."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from zlmreport.plugin import MICROMETRE, MILLIMETRE, FloatArray, InputError, Place, Problem, read_only_floats
from zlmreport_step_gauge import equations
from zlmreport_step_gauge.gauge import Face
from zlmreport_step_gauge.probed import Probed
from zlmreport_step_gauge.set_up import GaugeSetUp

#: Of the smallest distance between faces: a deviation that is larger is a face that was mistaken.
_OF_A_STEP = 0.1
#: A gauge is taken to be reversed, or its calibration to have the wrong sign, where this much less is left
#: when it is read the other way. By chance that is hardly so: the errors of the machine would have to follow
#: what the blocks of this gauge depart from nominal.
_REVERSED = 4.0
_FEWEST_FACES = 8


@dataclass(frozen=True, slots=True)
class Deviations:
    """What a test comes to."""

    values: FloatArray  #: (face, cycle): XF and XB, m; NaN where a point is missing.
    #: Unit vector along which points were projected; None for distances.
    direction: tuple[float, float, float] | None
    radius: EffectiveRadius  #: What was taken off.
    compensated: FloatArray  #: (face,): What the compensation of temperatures changed, m.


def compute_deviations_of(
    probed: Probed, set_up: GaugeSetUp, place: Place, *, is_corrected: bool
) -> Deviations:
    """Return the deviations of a test.

    Raises `InputError` if the points do not fit the section: another one was probed, the gauge lies the other
    way round, or the radius cannot be.
    """
    direction = _find_direction(probed, set_up)
    along = probed.coordinates @ np.array(direction) if direction else probed.coordinates[..., 0]
    problems = list(_find_not_rising(probed, along, place))
    if problems:
        raise InputError(problems)
    actual, growth = _compute_distances(probed, set_up)
    radius = (
        _compute_radius_of(probed, set_up, along, actual, place)
        if not is_corrected
        else EffectiveRadius(RadiusSource.MACHINE)
    )
    surface = along - probed.sides[:, np.newaxis] * radius.radius
    expanded = surface * set_up.scale_expansion.factor if set_up.scale_expansion else surface
    reference = float(np.nanmean(expanded[0]))
    values = equations.error(expanded, np.array(reference), actual[:, np.newaxis], np.array(actual[0]))
    problems = list(_find_another_section(probed, values, place))
    if not problems:
        problems = list(_find_exchanged_sign(probed, values, place))
    if not problems and direction is not None:
        problems = list(_find_reversed(probed, values, place))
    if problems:
        raise InputError(problems)
    means = np.nanmean(surface, axis=-1)
    scale = set_up.scale_expansion.factor - 1 if set_up.scale_expansion else 0.0
    return Deviations(
        values=read_only_floats(values),
        direction=direction,
        radius=radius,
        compensated=read_only_floats(scale * (means - means[0]) - (growth - growth[0])),
    )


def _find_direction(probed: Probed, set_up: GaugeSetUp) -> tuple[float, float, float] | None:
    """Return C1C2; without initial points, the line through the probed points of one side."""
    if probed.coordinates.shape[-1] == 1:
        return None
    if set_up.located:
        return set_up.located.location.direction
    means = np.nanmean(probed.coordinates, axis=1)
    of_one_side = means[probed.sides == probed.sides[0]]
    centred = of_one_side - of_one_side.mean(axis=0)
    line = np.linalg.svd(centred)[2][0]
    x, y, z = (line * math.copysign(1.0, float((of_one_side[-1] - of_one_side[0]) @ line))).tolist()
    return x, y, z


def _compute_distances(probed: Probed, set_up: GaugeSetUp) -> tuple[FloatArray, FloatArray]:
    """Return the actual distances S of the faces, m, and how much of them is expansion."""
    calibrated = np.array([face.distance for face in probed.faces])
    expansion = set_up.gauge_expansion
    growth = calibrated * (expansion.factor - 1) if expansion else np.zeros_like(calibrated)
    return calibrated + growth, growth


def _find_not_rising(probed: Probed, along: FloatArray, place: Place) -> Iterator[Problem]:
    """Yield that positions fall along C1C2 while the numbers of the faces rise."""
    means = np.nanmean(along, axis=-1)
    for side in np.unique(probed.sides):
        of_side = np.flatnonzero(probed.sides == side)
        steps = np.diff(means[of_side])
        if steps.size and np.all(steps < 0):
            yield Problem(
                place,
                "the faces were probed in the direction opposite to C1C2: beginning and end are exchanged "
                "in the initial points, or the faces are numbered from the wrong end of the gauge",
            )
            return
        for index in np.flatnonzero(steps <= 0).tolist():
            later, earlier = probed.faces[of_side[index + 1]].number, probed.faces[of_side[index]].number
            yield Problem(
                place,
                f"face {later} does not lie behind face {earlier}; are the two exchanged, or one missed?",
            )


def _find_another_section(probed: Probed, values: FloatArray, place: Place) -> Iterator[Problem]:
    nominal = np.array([face.nominal for face in probed.faces])
    largest = _OF_A_STEP * float(np.min(np.diff(nominal)))
    by_point = {(point.face, point.cycle): point.place for point in probed.points}
    beyond = np.argwhere(np.abs(values) > largest).tolist()
    for face, cycle in beyond[:1]:
        number = probed.faces[face].number
        yield Problem(
            by_point.get((number, probed.cycles[cycle]), place),
            f"face {number} lies {MICROMETRE.from_si(float(values[face, cycle])):.1f} µm from where the "
            f"calibration has it (points like this: {len(beyond)}); is this the section that was probed "
            "(step_gauge.first_block, last_block), was a face missed, and does the calibration belong to "
            "this gauge?",
        )


def _find_reversed(probed: Probed, values: FloatArray, place: Place) -> Iterator[Problem]:
    """Yield that the calibration fits far better when it is read from the other end."""
    whole = len(probed.faces) % 2 == 0 and len(set(probed.sides.tolist())) == 2
    if not whole or len(probed.faces) < _FEWEST_FACES:
        return
    means = np.nanmean(values, axis=-1)
    departure = np.array([face.distance - face.nominal for face in probed.faces])
    turned = -(departure[::-1] - departure[-1])
    from_the_end = means + (departure - departure[0]) - turned
    as_it_is, from_end = (_compute_left_over(each, probed) for each in (means, from_the_end))
    if as_it_is > _REVERSED * from_end:
        yield Problem(
            place,
            "the calibration fits the points far better from its other end "
            f"({MICROMETRE.from_si(from_end):.2f} µm are left instead of "
            f"{MICROMETRE.from_si(as_it_is):.2f} µm): the gauge lies the other way round; exchange beginning "
            "and end, and number the faces from there",
        )


def _find_exchanged_sign(probed: Probed, values: FloatArray, place: Place) -> Iterator[Problem]:
    """Yield that the calibration fits far better when its departures from nominal have the other sign."""
    if len(probed.faces) < _FEWEST_FACES:
        return
    means = np.nanmean(values, axis=-1)
    departure = np.array([face.distance - face.nominal for face in probed.faces])
    exchanged = means + 2 * (departure - departure[0])
    as_it_is, otherwise = (_compute_left_over(each, probed) for each in (means, exchanged))
    if as_it_is > _REVERSED * otherwise:
        yield Problem(
            place,
            "the calibration fits the points far better where its distances depart from nominal the other "
            f"way ({MICROMETRE.from_si(otherwise):.2f} µm are left instead of "
            f"{MICROMETRE.from_si(as_it_is):.2f} µm): were nominal − calibrated entered for calibrated − "
            "nominal? State the distances of the certificate",
        )


def _compute_left_over(values: FloatArray, probed: Probed) -> float:
    """Return the standard deviation about a straight line with a step between the two sides, m."""
    nominal = np.array([face.nominal for face in probed.faces])
    columns = np.stack([np.ones_like(nominal), nominal - nominal.mean(), probed.sides], axis=-1)
    residuals = values - columns @ np.linalg.lstsq(columns, values, rcond=None)[0]
    return float(np.sqrt(residuals @ residuals / (len(values) - columns.shape[1])))


#: How far the effective radius can lie from the nominal one, m: pretravel and bending are some micrometres.
_RADIUS = 0.1e-3


class RadiusSource(Enum):
    """Where the effective radius of the probe is from.

    MACHINE: the points are those of the surface. STATED: the job. BLOCKS: the blocks of the gauge, by Eq. 1.
    NOWHERE: all faces are touched from one side, and it cancels.
    """

    MACHINE = "machine"
    STATED = "stated"
    BLOCKS = "blocks"
    NOWHERE = "nowhere"


@dataclass(frozen=True, slots=True)
class EffectiveRadius:
    """The radius that was taken off, and how well it is known."""

    source: RadiusSource  #: Where it is from.
    radius: float = 0.0  #: R_eff, m; 0 where nothing is taken off.
    #: (block,): R_eff of each block by itself, m; empty where it was not determined from the gauge.
    by_block: FloatArray = field(default_factory=lambda: read_only_floats([]))
    scatter: float = math.nan  #: Standard deviation of these, m; NaN of fewer than two blocks.
    #: Standard uncertainty of R_eff, m: as stated, or `compute_radius_uncertainty`. What the machine's
    #: reversal, or its error within a block, adds is not in it.
    uncertainty: float = 0.0


def _compute_radius_of(
    probed: Probed, set_up: GaugeSetUp, along: FloatArray, actual: FloatArray, place: Place
) -> EffectiveRadius:
    """Return the effective radius of the probe in a test of centres of the tip.

    `along`, (face, cycle): Where the centres lie along the gauge, m.
    `actual`, (face,): Distances of the faces at the temperature of the test, m.

    Raises `InputError` if it is far from the nominal radius.
    """
    stated, nominal = set_up.effective_radius, set_up.tip_radius
    if stated:
        found = EffectiveRadius(RadiusSource.STATED, stated.radius, uncertainty=stated.uncertainty)
    elif len(set(probed.sides.tolist())) == 1:
        return EffectiveRadius(RadiusSource.NOWHERE)
    else:
        found = _from_blocks(probed, along, actual)
    if nominal is not None and abs(found.radius - nominal) > _RADIUS:
        hint = (
            "are the points those of the surface? Then state step_gauge.radius_correction: true"
            if abs(found.radius) < _RADIUS
            else "is step_gauge.tip_radius right, and does the calibration belong to this gauge?"
        )
        raise InputError.at(
            place,
            f"the effective radius is {MILLIMETRE.from_si(found.radius):.4f} mm, and the nominal one "
            f"{MILLIMETRE.from_si(nominal):.4f} mm; {hint}",
        )
    return found


def _from_blocks(probed: Probed, along: FloatArray, actual: FloatArray) -> EffectiveRadius:
    """Return R_eff by Eq. 1, the mean over all blocks."""
    means = np.nanmean(along, axis=-1)
    pairs = np.array(
        [
            (index, index + 1)
            for index, face in enumerate(probed.faces[:-1])
            if probed.faces[index + 1].block == face.block
        ],
        dtype=np.int64,
    ).reshape(-1, 2)
    by_block = equations.effective_radius(np.diff(means[pairs])[:, 0], np.diff(actual[pairs])[:, 0])
    scatter = float(np.std(by_block, ddof=1)) if by_block.size > 1 else math.nan
    return EffectiveRadius(
        RadiusSource.BLOCKS,
        float(by_block.mean()),
        read_only_floats(by_block),
        scatter,
        compute_radius_uncertainty(by_block, probed.faces),
    )


def compute_radius_uncertainty(by_block: FloatArray, faces: Sequence[Face]) -> float:
    """Return the standard uncertainty of the mean of the radii of single blocks, m.

    `by_block`, (block,): R_eff of each block, or what it differs by from the mean of all, m.

    It is s/√n of the blocks, in which their calibration shows too; or what follows from the calibration
    alone, where so few blocks happen to scatter less.
    """
    number = len(by_block)
    of_faces = math.fsum((face.expanded_uncertainty / 2) ** 2 for face in faces)
    of_calibration = math.sqrt(of_faces) / (2 * number)
    if number < 2:
        return of_calibration
    return max(float(np.std(by_block, ddof=1)) / math.sqrt(number), of_calibration)
