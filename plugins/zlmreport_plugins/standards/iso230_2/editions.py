"""What tells the editions of ISO 230-2 apart."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.plugin import Basis


@dataclass(frozen=True, slots=True)
class Edition:
    """One edition.

    Attributes
    ----------
    year
        Of publication.
    coverage_factor
        k: limits are x̄ ± k·s. 3 in 1988 (ZLM, G 1.3), 2 since 1997 (confirmed by published results).
    position_index
        The letter that counts target positions: j in 1988, i since; the other one counts the runs.
    defines_systematic_deviation
        Whether E and M exist: since 1997.
    prints_reversal_as_negative_minus_positive
        Whether the mean reversal value is printed as x̄↓ − x̄↑: in 1988 (ZLM, G 1.3).
    long_axis
        Where the rule for axes above 2000 mm or 360° is known from; None where the edition has none.
    """

    year: int
    coverage_factor: int
    position_index: str
    defines_systematic_deviation: bool
    prints_reversal_as_negative_minus_positive: bool
    long_axis: Basis | None


EDITIONS = (
    Edition(
        year=1988,
        coverage_factor=3,
        position_index="j",
        defines_systematic_deviation=False,
        prints_reversal_as_negative_minus_positive=True,
        long_axis=None,
    ),
    Edition(
        year=1997,
        coverage_factor=2,
        position_index="i",
        defines_systematic_deviation=True,
        prints_reversal_as_negative_minus_positive=False,
        long_axis=Basis.APPLIED,
    ),
    Edition(
        year=2006,
        coverage_factor=2,
        position_index="i",
        defines_systematic_deviation=True,
        prints_reversal_as_negative_minus_positive=False,
        long_axis=Basis.APPLIED,
    ),
    Edition(
        year=2014,
        coverage_factor=2,
        position_index="i",
        defines_systematic_deviation=True,
        prints_reversal_as_negative_minus_positive=False,
        long_axis=Basis.PUBLISHED,
    ),
)
