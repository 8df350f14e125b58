"""The effective radius of the probe: stated, or determined from the blocks of the gauge by Eq. 1."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge import equations
from zlmreport.step_gauge.gauge import Face
from zlmreport.step_gauge.probed import Probed
from zlmreport.step_gauge.set_up import GaugeSetUp

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
    """The radius that was taken off, and how well it is known.

    Attributes
    ----------
    source
        Where it is from.
    radius
        R_eff, m; 0 where nothing is taken off.
    by_block : (block,) array
        R_eff of each block by itself, m; empty where it was not determined from the gauge.
    scatter
        Standard deviation of these, m; NaN of fewer than two blocks.
    uncertainty
        Standard uncertainty of R_eff, m: as stated, or `radius_uncertainty`. What the machine's reversal, or
        its error within a block, adds is not in it.
    """

    source: RadiusSource
    radius: float = 0.0
    by_block: FloatArray = field(default_factory=lambda: read_only_floats([]))
    scatter: float = math.nan
    uncertainty: float = 0.0


def radius_of(
    probed: Probed, set_up: GaugeSetUp, along: FloatArray, actual: FloatArray, place: Place
) -> EffectiveRadius:
    """Return the effective radius of the probe in a test of centres of the tip.

    Parameters
    ----------
    probed
        The faces.
    set_up
        What is stated of the probe.
    along : (face, cycle) array
        Where the centres lie along the gauge, m.
    actual : (face,) array
        Distances of the faces at the temperature of the test, m.
    place
        The file of the points.

    Raises
    ------
    InputError
        If it is far from the nominal radius.
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
        radius_uncertainty(by_block, probed.faces),
    )


def radius_uncertainty(by_block: FloatArray, faces: Sequence[Face]) -> float:
    """Return the standard uncertainty of the mean of the radii of single blocks, m.

    Parameters
    ----------
    by_block : (block,) array
        R_eff of each block, or what it differs by from the mean of all, m.
    faces
        Of these blocks.

    Notes
    -----
    It is s/√n of the blocks, in which their calibration shows too; or what follows from the calibration
    alone, where so few blocks happen to scatter less.
    """
    number = len(by_block)
    of_faces = math.fsum((face.expanded_uncertainty / 2) ** 2 for face in faces)
    of_calibration = math.sqrt(of_faces) / (2 * number)
    if number < 2:
        return of_calibration
    return max(float(np.std(by_block, ddof=1)) / math.sqrt(number), of_calibration)
