"""What an interferometer that did not know its air has displayed, and what it should have.

The instrument counts half wavelengths. From its datum on it has counted n·(Dp + D) − n₀·Dp in vacuum
units: n is the index of the air now, n₀ that when it was set to zero, Dp the dead path, D the displacement.
It displayed the count over the index nₐ that it assumed. Solved for D:

    D = (nₐ/n)·(displayed displacement) − Dp·(n − n₀)/n.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import Correction
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.quantities.units import above_reference


def displacement_in_air(displayed: FloatArray, index: FloatArray, assumed_index: float) -> FloatArray:
    """Return the displacement by the true wavelength, D·nₐ/n.

    Parameters
    ----------
    displayed : (N,) array
        Displacement from the datum as the instrument displayed it, m.
    index : (N,) array
        n at each reading.
    assumed_index
        nₐ.
    """
    return displayed * (assumed_index / index)


def dead_path_error(index: FloatArray, index_at_datum: float, dead_path: float) -> FloatArray:
    """Return how far the air along the dead path has moved the datum, Dp·(n − n₀)/n, m.

    Parameters
    ----------
    index : (N,) array
        n at each reading.
    index_at_datum
        n₀, when the instrument was set to zero.
    dead_path
        Dp, m.
    """
    return dead_path * (index - index_at_datum) / index


_AIR = Words(en="Refractive index of air", de="Brechzahl der Luft")
_AIR_METHOD = Words(
    en="updated Edlén equation (Birch and Downs 1993, 1994); D·nₐ/n",
    de="aktualisierte Edlén-Gleichung (Birch und Downs 1993, 1994); D·nₐ/n",
)
_AIR_INPUTS = Words(
    en="n − 1 from {low} to {high} × 10⁻⁶; the instrument assumed {assumed} × 10⁻⁶",
    de="n − 1 von {low} bis {high} × 10⁻⁶; das Gerät nahm {assumed} × 10⁻⁶ an",
)
_DEAD_PATH = Words(en="Dead path", de="Totstrecke")
_DEAD_PATH_METHOD = Words(
    en="change of the index since the first reading; Dp·(n − n₀)/n",
    de="Änderung der Brechzahl seit dem ersten Messwert; Dp·(n − n₀)/n",
)
_DEAD_PATH_INPUTS = Words(en="Dp = {length} mm", de="Dp = {length} mm")
_MATERIAL = Words(en="Thermal expansion, to 20 °C", de="Wärmeausdehnung, auf 20 °C")
_MATERIAL_METHOD = Words(en="D·(1 − α·(T − 20 °C))", de="D·(1 − α·(T − 20 °C))")
_MATERIAL_INPUTS = Words(
    en="α = {alpha} µm/(m·K), T − 20 °C from {low} to {high} K",
    de="α = {alpha} µm/(m·K), T − 20 °C von {low} bis {high} K",
)


@dataclass(frozen=True, slots=True)
class Air:
    """The refractive index of the air.

    Attributes
    ----------
    index : (N,) array
        n at each reading.
    assumed_index
        That by which the instrument turned counts into lengths.
    """

    index: FloatArray
    assumed_index: float


@dataclass(frozen=True, slots=True)
class Expansion:
    """The expansion of the material.

    Attributes
    ----------
    coefficient
        α, 1/K.
    temperature : (N,) array
        T at each reading, K.
    """

    coefficient: float
    temperature: FloatArray


@dataclass(frozen=True, slots=True)
class Corrections:
    """What the readings of a test are corrected for; None for what they are not.

    Attributes
    ----------
    datum
        Position at which the instrument was set to zero, m.
    air, expansion
        See there.
    dead_path
        From the interferometer to the reflector at the datum, m; negative where the measured path shrinks
        while the position rises. It needs the index of the air.
    """

    datum: float
    air: Air | None = None
    dead_path: float | None = None
    expansion: Expansion | None = None


def corrected(measurements: MeasurementSet, corrections: Corrections) -> MeasurementSet:
    """Return a new set of readings, corrected, with every correction in its provenance.

    The displacement from the datum is corrected; a target position is what the axis was commanded to, and
    stays as it is.
    """
    target = measurements.target_positions[measurements.target]
    displacement = target + measurements.deviation - corrections.datum
    applied: list[Correction] = []
    if corrections.air is not None:
        displacement, found = _in_air(displacement, corrections.air)
        applied.append(found)
        if corrections.dead_path is not None:
            displacement, found = _without_dead_path(displacement, corrections.air, corrections.dead_path)
            applied.append(found)
    if corrections.expansion is not None:
        displacement, found = _at_20_degrees(displacement, corrections.expansion)
        applied.append(found)
    deviation = read_only_floats(displacement + corrections.datum - target)
    provenance = replace(measurements.provenance, corrections=tuple(applied))
    return replace(measurements, deviation=deviation, provenance=provenance)


def _in_air(displayed: FloatArray, air: Air) -> tuple[FloatArray, Correction]:
    displacement = displacement_in_air(displayed, air.index, air.assumed_index)
    inputs = _AIR_INPUTS.given(
        low=_millionths(air.index.min()),
        high=_millionths(air.index.max()),
        assumed=_millionths(air.assumed_index),
    )
    return displacement, Correction(_AIR, _AIR_METHOD, inputs, _largest(displacement - displayed))


def _without_dead_path(displacement: FloatArray, air: Air, dead_path: float) -> tuple[FloatArray, Correction]:
    error = dead_path_error(air.index, float(air.index[0]), dead_path)
    inputs = _DEAD_PATH_INPUTS.given(length=1e3 * abs(dead_path))
    return displacement - error, Correction(_DEAD_PATH, _DEAD_PATH_METHOD, inputs, _largest(error))


def _at_20_degrees(displacement: FloatArray, expansion: Expansion) -> tuple[FloatArray, Correction]:
    difference = above_reference(expansion.temperature)
    change = -displacement * expansion.coefficient * difference
    inputs = _MATERIAL_INPUTS.given(
        alpha=1e6 * expansion.coefficient, low=float(difference.min()), high=float(difference.max())
    )
    return displacement + change, Correction(_MATERIAL, _MATERIAL_METHOD, inputs, _largest(change))


def _largest(change: FloatArray) -> float:
    """Return the change of the largest amount, with its sign; 0 where there are no readings."""
    known = change[np.isfinite(change)]
    return float(known[np.argmax(np.abs(known))]) if len(known) else 0.0


def _millionths(index: float) -> float:
    return round(1e6 * (float(index) - 1.0), 2)
