"""Several tests of one axis against one model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import EFFECTS, INSTALLED, linear_test, model_of, noise
from zlmreport.measurement.arrays import read_only_integers
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, diagnose
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.noise import NoiseSource, list_noise_parts
from zlmreport.model.fitting.observations import Observations, select_of_the_job
from zlmreport.model.fitting.sessions import add_zeros, join_sessions
from zlmreport.plugin import FloatArray, Language, same_in_all_languages as same
from zlmreport.plugin.effect import Design

_STRAIGHT = model_of("offset", "backlash")
_LOG = "axis_temperature"


def _test(kelvin: float, seed: int) -> Design:
    """Return a test at a steady temperature, and no other log."""
    design = linear_test(targets=15, runs=3, seed=seed)
    return replace(design, conditions={_LOG: np.full(len(design.position), 293.15 + kelvin)})


def _session(kelvin: float, seed: int, hidden: str, *, zero: float = 0.0) -> Observations:
    """Return a test in which a hidden effect makes 10 µm/m at 2 K."""
    design = _test(kelvin, seed)
    size = {"scale-expansion": 5e-6, "scale-error": 10e-6}[hidden]
    column = EFFECTS[hidden].columns(design, np.empty(0))[:, 0]
    backlash = EFFECTS["backlash"].columns(design, np.empty(0))[:, 0]
    deviation = size * column - 4e-6 * backlash + zero + noise(design, seed, 0.5e-6)
    return Observations(design, deviation, read_only_integers(np.arange(len(deviation))), ())


def _diagnosed(observed: Observations) -> AxisDiagnosis:
    return diagnose(add_zeros(_STRAIGHT, observed.design), observed, INSTALLED)


@pytest.mark.long
@pytest.mark.parametrize("hidden", ["scale-expansion", "scale-error"])
def test_two_temperatures_decide_what_one_leaves_open(hidden: str) -> None:
    cool, warm = _session(2.0, 1, hidden), _session(5.0, 2, hidden, zero=-7e-6)
    alone = _diagnosed(cool).candidates[0]
    assert {alone.identifier, *alone.equals} == {"scale-error", "scale-expansion"}
    together = _diagnosed(join_sessions(cool, [("warm.yaml", warm)])).candidates[0]
    assert (together.identifier, together.equals) == (hidden, ())
    assert together.probability > 0.95  # odds of 20 to 1


def test_two_tests_at_one_temperature_decide_nothing() -> None:
    cool, again = (_session(2.0, seed, "scale-expansion") for seed in (1, 2))
    leading = _diagnosed(join_sessions(cool, [("again.yaml", again)])).candidates[0]
    assert {leading.identifier, *leading.equals} == {"scale-error", "scale-expansion"}


def test_the_fit_of_two_sessions_is_least_squares_on_their_readings_below_one_another() -> None:
    cool, warm = (_session(2.0, 1, "scale-expansion"), _session(5.0, 2, "scale-expansion", zero=-7e-6))
    both = join_sessions(cool, [("warm.yaml", warm)])
    model = add_zeros(model_of("offset", "backlash", "scale-expansion"), both.design)
    fitted = fit(model, both.design, both.deviation)
    first, second = cool.design, warm.design

    def stacked(effect: str) -> FloatArray:
        parts = [EFFECTS[effect].columns(each, np.empty(0))[:, 0] for each in (first, second)]
        return np.concatenate(parts)

    is_second = np.repeat([0.0, 1.0], [len(first.position), len(second.position)])
    columns = np.column_stack([is_second, *map(stacked, ("offset", "backlash", "scale-expansion"))])
    covariance = np.diag(fitted.noise.weights)
    for part in list_noise_parts(both.design):
        covariance += fitted.noise.ratios[part.source] * part.factor @ part.factor.T
    inverse = np.linalg.inv(covariance)
    expected = np.linalg.solve(columns.T @ inverse @ columns, columns.T @ inverse @ both.deviation)
    np.testing.assert_allclose([each.value for each in fitted.estimates], expected, rtol=1e-7)
    assert expected[0] == pytest.approx(-7e-6, abs=1e-6)


def test_each_session_has_its_own_clock_drift_and_first_run_and_shares_its_targets() -> None:
    cool, warm = _session(2.0, 1, "scale-error"), _session(5.0, 1, "scale-error")
    both = join_sessions(cool, [("warm.yaml", warm)])
    design, count = both.design, len(cool.deviation)
    assert design.time[count] == design.time[0] == 0.0
    assert sorted(set(design.cycle.tolist())) == [1, 2, 3, 4, 5, 6]
    first_run = EFFECTS["first-run"].columns(design, np.empty(0))[:, 0]
    assert set(design.cycle[first_run == 1].tolist()) == {1, 4}
    parts = {part.source: part.factor for part in list_noise_parts(design)}
    assert parts[NoiseSource.POSITION].shape[1] == 15
    drift = parts[NoiseSource.TIME] @ parts[NoiseSource.TIME].T
    assert np.all(drift[:count, count:] == 0)
    np.testing.assert_allclose(np.diag(drift), 1.0)
    own = select_of_the_job(both)
    assert own.reading.tolist() == cool.reading.tolist()
    np.testing.assert_array_equal(own.design.position, cool.design.position)


def test_a_log_that_one_session_lacks_is_left_out_and_said() -> None:
    cool, warm = _session(2.0, 1, "scale-error"), _session(5.0, 2, "scale-error")
    warm = replace(warm, design=replace(warm.design, conditions={}))
    both = join_sessions(cool, [("warm.yaml", warm)])
    assert not both.design.conditions
    said = [each.in_language(Language.ENGLISH) for each in both.remarks]
    assert said[0].startswith("Session 2, warm.yaml: runs 4 to 6")
    assert said[1] == "Not every session logged axis_temperature: the model does without."


def test_a_remark_on_one_session_says_on_which_and_one_on_all_stands_once() -> None:
    cool, warm = _session(2.0, 1, "scale-error"), _session(5.0, 2, "scale-error")
    cool, warm = (
        replace(each, remarks=(same("An overrun is taken."), same(f"A noise of {noise}.")))
        for each, noise in ((cool, 2), (warm, 3))
    )
    said = [each.in_language(Language.ENGLISH) for each in join_sessions(cool, [("w", warm)]).remarks]
    assert said[:3] == ["An overrun is taken.", "Session 1: A noise of 2.", "Session 2: A noise of 3."]


def test_times_in_one_session_and_none_in_the_other_are_refused() -> None:
    cool, warm = _session(2.0, 1, "scale-error"), _session(5.0, 2, "scale-error")
    warm = replace(warm, design=replace(warm.design, time_is_counted=True))
    with pytest.raises(ModelError, match=r"warm\.yaml and the job must both have a time"):
        join_sessions(cool, [("warm.yaml", warm)])
