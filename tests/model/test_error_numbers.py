"""The error of a model is what it leaves at its best, and no effect that comes in raises it by much."""

from __future__ import annotations

import numpy as np
import pytest

from model.axis_tests import linear_test, model_of, noise
from model.worlds import with_night
from zlmreport.model.diagnosis.error_numbers import compute_error_numbers
from zlmreport.model.fitting.fit import Fit, fit

_DESIGN = linear_test(15, 5)
_MOMENT = _DESIGN.time / np.ptp(_DESIGN.time)
#: It begins after a fifth of the test, and is nothing that has a name.
_STRANGER = 6e-6 * (_MOMENT > 0.2) * np.sin(48 * _MOMENT) + noise(_DESIGN, sigma=3e-7)


def _fit(*effects: str) -> Fit:
    return fit(model_of(*effects), _DESIGN, _STRANGER)


def test_beside_what_drifts_a_constant_leaves_the_scatter_about_the_mean() -> None:
    fitted = _fit("offset")
    # Weighted for the drift, the constant may lie anywhere, and the readings far from it.
    assert fitted.rms > 1.02 * np.std(_STRANGER, ddof=1)
    assert compute_error_numbers(fitted).rms == pytest.approx(np.std(_STRANGER, ddof=1))


@pytest.mark.parametrize("effect", ["scale-error", "backlash", "first-run", "backlash-gradient"])
def test_an_effect_that_is_added_leaves_no_larger_sum_of_squares(effect: str) -> None:
    before, after = _fit("offset"), _fit("offset", effect)
    least, most = (compute_error_numbers(each).rms ** 2 * each.degrees for each in (after, before))
    assert least <= most * (1 + 1e-9)


def test_independent_readings_leave_what_the_fit_leaves() -> None:
    fitted = fit(model_of("offset", "scale-error"), _DESIGN, noise(_DESIGN))
    assert compute_error_numbers(fitted).rms == pytest.approx(fitted.rms, rel=0.01)


def test_a_run_is_predicted_by_others_among_which_there_is_no_pause() -> None:
    design = with_night(linear_test(9, 3), run=2)
    grown = 3e-6 * design.position * (design.run == 3)
    fitted = fit(model_of("offset", "growth-after-pause"), design, grown + noise(design, sigma=3e-7))
    assert compute_error_numbers(fitted).cross_validated_rms > fitted.rms
