"""How the figures that are stated of a set-up become contributions: one formula each.

These are the contributors that ISO/TR 230-9:2005 lists for ISO 230-2, in this project's own words; each takes
a full range R of possible values, so that u = R/√12 (JCGM 100, 4.3.7). Lengths in m, angles in rad.
"""

from __future__ import annotations

from zlmreport.uncertainty.contribution import Distribution


def from_range(full_range: float, distribution: Distribution) -> float:
    """Return u of an error that lies in a range: R/√12 if all its values are alike (JCGM 100, 4.3.7)."""
    return full_range / distribution.range_over_standard_uncertainty


def misalignment_range(misalignment: float, length: float) -> float:
    """Return the range of the cosine error, R²/(2L), m.

    A measuring line that departs from the axis by R over the length L sees L·cos(R/L) ≈ L − R²/(2L): the
    error lies between zero and this range, and never on the other side of zero.
    """
    return misalignment**2 / (2 * length) if length else 0.0


def temperature_range(expansion_coefficient: float, length: float, temperature_range: float) -> float:
    """Return the range α·L·R(θ) of the error from the measured temperature of machine or device, m."""
    return abs(expansion_coefficient) * length * temperature_range


def expansion_range(length: float, difference: float, coefficient_range: float) -> float:
    """Return the range L·ΔT·R(α) of the error from the expansion coefficient of machine or device, m.

    Parameters
    ----------
    length
        L, m.
    difference
        ΔT, the largest distance of the temperature from 20 °C, K.
    coefficient_range
        R(α), 1/K.
    """
    return length * abs(difference) * coefficient_range
