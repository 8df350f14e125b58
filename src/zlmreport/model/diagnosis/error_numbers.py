"""χ²/ν and RMS of a fitted model beside the noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import FloatArray, compute_left_beside
from zlmreport.model.fitting.fit import Fit, cross_validate
from zlmreport.model.fitting.repeats import estimate_noise_floor

#: Largest ratio of two variances that are alike.
LARGEST_RATIO = 1.4
#: Sum of squares of a residual that is no residual at all.
_NOTHING = 1e-60


@dataclass(frozen=True, slots=True)
class ErrorNumbers:
    """How far readings and model are apart."""

    rms: float  #: √(RSS/(N − q)) at the sizes that leave least, all readings alike, m or rad.
    noise_rms: float | None  #: The noise floor σ_f, m or rad; None without repeats.
    chi2_per_dof: float | None  #: RSS/((N − q)·σ_f²); None without a noise floor.
    cross_validated_rms: float | None  #: Of runs predicted from the others, m or rad; None with a single run.


def compute_error_numbers(fitted: Fit) -> ErrorNumbers:
    """Return how far a fitted model is from the readings."""
    floor = estimate_noise_floor(fitted.design, choose_scattering(fitted))
    return make_error_numbers(fitted, _compute_least_rms(fitted), floor)


def make_error_numbers(fitted: Fit, rms: float, floor: float | None) -> ErrorNumbers:
    """Return the numbers of a fitted model that leaves an RMS beside a noise floor, m or rad."""
    return ErrorNumbers(
        rms,
        floor,
        (rms / floor) ** 2 if floor else None,
        cross_validate(fitted.model, fitted.design, fitted.deviation, fitted.solution.thetas),
    )


def _compute_least_rms(fitted: Fit) -> float:
    """Return what a model leaves of a single reading, its searched parameters as fitted, m or rad.

    Beside a slow drift, readings hardly determine what is constant, and a fit that knows it may put that
    anywhere: what it leaves then says nothing of the model, and may rise with an effect that is there.
    """
    solved = [own for own, _ in fitted.model.compute_columns(fitted.design, fitted.solution.thetas)]
    columns = np.concatenate([np.empty((len(fitted.deviation), 0)), *solved], axis=1)
    left = compute_left_beside(columns, fitted.open_deviation)
    return float(np.sqrt(np.sum(left**2) / fitted.degrees))


def choose_scattering(fitted: Fit) -> FloatArray:
    """Return the deviations whose repeats show the noise, (N,): as measured, whatever the model.

    Where a model explains how repeats differ (a first run that stands off, each target read in one go), it is
    what it leaves of them: else what has a name counts as noise, and what has none is lost in it.
    """
    as_measured = estimate_noise_floor(fitted.design, fitted.deviation)
    left = estimate_noise_floor(fitted.design, fitted.residual)
    is_explained = as_measured is not None and left is not None and as_measured**2 > LARGEST_RATIO * left**2
    return fitted.residual if is_explained else fitted.deviation


def compute_schwarz_criterion(fitted: Fit) -> float:
    """Return by what models with more and with fewer parameters are compared: the less, the better.

    G. Schwarz, Annals of Statistics 6 (1978) 461.
    """
    readings, squares = len(fitted.deviation), max(fitted.rms**2 * fitted.degrees, _NOTHING)
    return float(readings * np.log(squares / readings) + (readings - fitted.degrees) * np.log(readings))
