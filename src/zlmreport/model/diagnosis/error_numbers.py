"""How far a fitted model is from the readings, beside their noise."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.model.fitting.fit import Fit, cross_validate
from zlmreport.model.fitting.repeats import estimate_noise_floor


@dataclass(frozen=True, slots=True)
class ErrorNumbers:
    """How far readings and model are apart."""

    rms: float  #: √(RSS/(N − q)), m or rad.
    noise_rms: float | None  #: The noise floor σ_f, m or rad; None without repeats.
    chi2_per_dof: float | None  #: RSS/((N − q)·σ_f²); None without a noise floor.
    cross_validated_rms: float | None  #: Of runs predicted from the others, m or rad; None with a single run.


def compute_error_numbers(fitted: Fit) -> ErrorNumbers:
    """Return how far a fitted model is from the readings."""
    floor = estimate_noise_floor(fitted.design, fitted.deviation)
    return ErrorNumbers(
        fitted.rms,
        floor,
        (fitted.rms / floor) ** 2 if floor else None,
        cross_validate(fitted.model, fitted.design, fitted.deviation, fitted.solution.thetas),
    )
