"""A job's model beside its readings: fits, history, and mistakes at their place in the job."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.hidden_effect import LAST, example, example_diagnosis, example_history, study, written
from refusals import refused
from zlmreport.model.diagnosis.error_numbers import compute_error_numbers
from zlmreport.model.diagnosis.study import Fitted
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import InputError


def problem(path: Path) -> tuple[int, int, str]:
    """Return line, column and message of what is wrong with a job's model."""
    (only,) = refused(study(path).fit_whole).problems
    assert only.place.file == str(path)
    return only.place.line, only.place.column, only.message


def test_the_model_has_the_effects_of_the_job_in_their_order() -> None:
    assert example().model.identifiers == ("offset", "scale-error", "backlash")


def test_values_of_the_job_are_held_fixed_in_si(tmp_path: Path) -> None:
    path = written(tmp_path, (LAST, "    - backlash: {lost_motion: -4.5}\n"))
    (estimate,) = [each for each in study(path).fit_whole().fit.estimates if each.effect == "backlash"]
    assert (estimate.value, estimate.is_given) == (pytest.approx(-4.5e-6), True)


def test_an_overrun_that_the_job_states_is_where_the_distance_since_a_reversal_begins(tmp_path: Path) -> None:
    found = study(written(tmp_path, ("model:\n", "plan: {overrun: 2}\nmodel:\n")))
    assert found.observed.design.since_reversal.min() == pytest.approx(2e-3)
    assert example().observed.design.since_reversal.min() == pytest.approx(5e-3)
    assert not [each for each in found.observed.remarks if "overrun" in each.values]


def test_the_instrument_errs_in_the_model_as_in_the_budget(tmp_path: Path) -> None:
    """U = 3 µm + 2 µm/m · L with k = 2 is 1.5 µm at each position and 1 µm/m along the length."""
    instrument = "instrument: {name: Laser, expanded_uncertainty: 3 + 2*L}\nmodel:\n"
    found = study(written(tmp_path, ("model:\n", instrument)))
    assert found.assumptions.instrument == InstrumentError(0.0, pytest.approx(1e-6), pytest.approx(1.5e-6))
    offset, without = found.fit_whole().fit.estimates[0], example().fit_whole().fit.estimates[0]
    assert offset.value == pytest.approx(without.value, abs=1e-15)
    assert offset.standard_uncertainty > without.standard_uncertainty


@pytest.mark.parametrize(
    ("acts", "expected"),
    [
        ("at-the-datum", (1.5e-6, 0.0, 0.0)),
        ("along-the-length", (0.0, 1.5e-6 / 0.6, 0.0)),
        ("at-each-reading", (0.0, 0.0, 0.0)),
    ],
)
def test_what_the_job_says_of_how_the_instrument_acts_holds_for_the_model(
    acts: str, expected: tuple[float, ...], tmp_path: Path
) -> None:
    keys = f"instrument: {{name: L, expanded_uncertainty: 3}}\nuncertainty: {{instrument_acts: {acts}}}\n"
    error = study(written(tmp_path, ("model:\n", f"{keys}model:\n"))).assumptions.instrument
    assert (error.common, error.proportional, error.at_each_position) == pytest.approx(expected, rel=0.05)


def test_an_uncertainty_in_words_is_none(tmp_path: Path) -> None:
    instrument = "instrument: {name: Laser, expanded_uncertainty: see its certificate}\nmodel:\n"
    found = study(written(tmp_path, ("model:\n", instrument)))
    assert found.assumptions.instrument == InstrumentError()


def test_the_history_begins_with_the_readings_alone() -> None:
    first = example_history()[0]
    assert first.fit.model.terms == ()
    assert first.error.rms == pytest.approx(float(np.sqrt(np.mean(first.fit.deviation**2))), rel=1e-12)


def test_the_history_takes_the_effects_in_one_after_another() -> None:
    assert [each.fit.model.identifiers for each in example_history()] == [
        (),
        ("offset",),
        ("offset", "scale-error"),
        ("offset", "scale-error", "backlash"),
    ]


def test_the_history_ends_with_the_model_that_is_diagnosed() -> None:
    last = example_history()[-1]
    assert last.error == example_diagnosis().error
    assert [each.value for each in last.fit.estimates] == [
        each.value for each in example_diagnosis().fit.estimates
    ]


def test_the_history_takes_a_fit_that_is_there() -> None:
    whole = example_history()[-1]
    assert example().fit_history(whole)[-1] is whole


def test_a_history_is_one_of_the_readings_that_the_whole_model_was_fitted_to() -> None:
    """A diagnosis sets aside what stands off beside its own curves, which need not be what a fit does."""
    every = example().together
    fewer = every.without(np.array([3, 40]))
    found = fit(example().model, fewer.design, fewer.deviation)
    history = example().fit_history(Fitted(found, compute_error_numbers(found)))
    assert {len(each.fit.deviation) for each in history} == {len(every.deviation) - 2}


def test_the_error_falls_to_the_noise_when_the_hidden_effect_is_added(tmp_path: Path) -> None:
    path = written(tmp_path, (LAST, f"{LAST}    - screw-pitch\n"))
    errors = [each.error for each in study(path).fit_history()]
    assert [each.rms for each in errors] == sorted((each.rms for each in errors), reverse=True)
    assert errors[-1].noise_rms is not None
    assert errors[-1].rms < 1.2 * errors[-1].noise_rms < 0.4 * errors[-2].rms


def test_an_effect_that_cannot_be_fitted_is_refused_where_the_job_names_it(tmp_path: Path) -> None:
    path = written(tmp_path, (LAST, f"{LAST}    - abbe\n"))
    assert problem(path) == (
        26,
        7,
        "abbe cannot be fitted to these readings: the job does not state axis.angular_errors",
    )


def test_effects_that_collide_are_named(tmp_path: Path) -> None:
    path = written(tmp_path, (LAST, f"{LAST}    - polynomial\n"))
    with pytest.raises(InputError) as caught:
        study(path).fit_whole()
    messages = [each.message for each in caught.value.problems]
    assert [each.place.line for each in caught.value.problems] == [26, 26]
    assert "polynomial contains offset" in messages[0]
    assert "polynomial contains scale-error" in messages[1]


def test_effects_that_the_readings_do_not_part_are_named(tmp_path: Path) -> None:
    path = written(tmp_path, (LAST, f"{LAST}    - cosine-error\n"))
    _, _, message = problem(path)
    assert "scale-error and cosine-error apart" in message


def test_too_few_readings_are_told(tmp_path: Path) -> None:
    path = written(tmp_path)
    table = path.with_name("x-axis.csv")
    lines = table.read_text(encoding="utf-8").splitlines()
    table.write_text("\n".join(lines[:5]) + "\n", encoding="utf-8")
    assert "readings" in problem(path)[2]
