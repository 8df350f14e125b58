"""A slip in recording is named as what it is, with its run, and never as a cause of deviations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import (
    INSTALLED,
    formula,
    hidden,
    linear_test,
    model_of,
    noise,
    observations,
    pendulum_test,
)
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.faults import (
    FaultKind,
    find_lagging_sensors,
    find_pauses_between_runs,
    find_recorded_faults,
    run_faults,
)
from zlmreport.model.diagnosis.report import report
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.model.fitting.sessions import add_zeros, join_sessions
from zlmreport.plugin import Axis, AxisKind, FloatArray, Language
from zlmreport.plugin.effect import Design

_DESIGN = linear_test(11, 5)
_MODEL = model_of("offset", "scale-error", "backlash")
_THIRD = _DESIGN.run == 3
#: An irregular axis with 5 µm of backlash.
_TRUE = (
    1e-5 * _DESIGN.position
    - 2.5e-6 * _DESIGN.direction
    + 2e-6 * np.random.default_rng(5).standard_normal(11)[_DESIGN.target]
    + noise(_DESIGN, sigma=4e-7)
)


def _kinds(design: Design, deviation: FloatArray) -> list[tuple[FaultKind, int | None]]:
    return [(each.kind, each.run) for each in find_recorded_faults(design, deviation)]


def _slip(design: Design, deviation: FloatArray) -> list[tuple[FaultKind, int | None]]:
    return [(each.kind, each.run) for each in run_faults(fit(_MODEL, design, deviation))]


def test_sound_readings_have_no_fault() -> None:
    assert _kinds(_DESIGN, _TRUE) == []
    assert _slip(_DESIGN, _TRUE) == []


def test_run_whose_directions_were_swapped_is_told_by_the_other_runs() -> None:
    assert _slip(_swapped(), _TRUE) == [(FaultKind.SWAPPED_DIRECTION, 3)]


def test_order_of_the_rows_shows_swapped_directions() -> None:
    assert _kinds(_swapped(), _TRUE) == [(FaultKind.SWAPPED_DIRECTION, 3)]


@pytest.mark.parametrize("seed", range(6))
def test_readings_that_are_missing_turn_no_run_where_the_axis_turns_at_each_target(seed: int) -> None:
    # Beside a gap two rows of one direction stand side by side, and what that says is chance.
    design = pendulum_test(11, 5)
    kept = np.sort(np.random.default_rng(seed).permutation(len(design.position))[8:])
    assert _kinds(select_readings(design, kept), noise(design)[kept]) == []


def test_swapped_directions_are_a_fault_and_no_cause() -> None:
    found = diagnose(_MODEL, observations(_swapped(), _TRUE), INSTALLED)
    assert found.verdict is DiagnosisVerdict.UNEXPLAINED
    assert found.faults[0].comes_first
    assert (found.together, found.candidates) == ((), ())
    (fault,) = report(found)["faults"]
    assert (fault["fault"], fault["run"], fault["probability"]) == ("swapped-direction", 3, 1.0)
    assert fault["statement"].endswith("were swapped; the order of its rows says so too")


def test_run_of_turned_sign_is_told_by_the_other_runs() -> None:
    assert _slip(_DESIGN, np.where(_THIRD, -_TRUE, _TRUE)) == [(FaultKind.WRONG_SIGN, 3)]


def test_run_that_was_moved_by_a_target_is_told_by_the_other_runs() -> None:
    moved = _TRUE.copy()
    for sign in (1.0, -1.0):
        rows = np.flatnonzero(_THIRD & (_DESIGN.direction == sign))
        rows = rows[np.argsort(_DESIGN.target[rows])]
        moved[rows] = np.roll(_TRUE[rows], 1)
    assert _slip(_DESIGN, moved) == [(FaultKind.SHIFTED_RUN, 3)]


def test_run_in_another_unit_is_told_by_its_size() -> None:
    assert (FaultKind.WRONG_UNIT, 3) in _kinds(_DESIGN, np.where(_THIRD, 1e-3 * _TRUE, _TRUE))


def test_test_that_hardly_deviates_is_asked_for_its_unit() -> None:
    (fault,) = find_recorded_faults(_DESIGN, 1e-3 * _TRUE)
    assert (fault.kind, fault.run) == (FaultKind.WRONG_UNIT, None)
    assert not fault.is_sure


def test_run_that_repeats_another_digit_for_digit_is_a_duplicate() -> None:
    copied = _TRUE.copy()
    copied[_THIRD] = _TRUE[_DESIGN.run == 1]
    assert _kinds(_DESIGN, copied) == [(FaultKind.DUPLICATED_RUN, 3)]


def test_quiet_machine_may_repeat_its_readings() -> None:
    assert _kinds(_DESIGN, np.round(-5e-6 * _DESIGN.direction + 2e-6, 7)) == []


def test_reading_of_another_target_is_told_by_the_distance() -> None:
    targets = _DESIGN.target_positions
    deviation = _TRUE.copy()
    place = int(np.flatnonzero(_THIRD & (_DESIGN.target == 4))[0])
    deviation[place] += targets[6] - targets[4]
    assert _kinds(_DESIGN, deviation) == [(FaultKind.WRONG_TARGET, 3)]


def test_target_that_was_written_wrongly_is_told_by_those_beside_it() -> None:
    off = np.where(_DESIGN.target == 4, 1e-3, 0.0)
    (fault,) = find_recorded_faults(_DESIGN, _TRUE + off)
    assert (fault.kind, fault.run) == (FaultKind.WRONG_TARGET, None)
    assert "stand 1002 µm off" in fault.statement.in_language(Language.ENGLISH)


def test_target_that_was_written_wrongly_is_told_beside_one_that_was_never_read() -> None:
    read = np.flatnonzero(_DESIGN.target != 2)
    deviation = _TRUE + np.where(_DESIGN.target == 6, 1e-3, 0.0)
    assert _kinds(select_readings(_DESIGN, read), deviation[read]) == [(FaultKind.WRONG_TARGET, None)]


def test_step_of_a_millimetre_between_two_targets_is_no_wrong_target() -> None:
    assert _kinds(_DESIGN, _TRUE + np.where(_DESIGN.target >= 4, 1e-3, 0.0)) == []


def test_bump_of_a_few_targets_is_no_wrong_target() -> None:
    bump = 4e-4 * np.exp(-(((_DESIGN.position - 0.25) / 0.08) ** 2))
    assert _kinds(_DESIGN, _TRUE + bump) == []


def test_readings_that_stay_the_same_from_target_to_target_are_of_an_instrument_that_stood_still() -> None:
    still = _TRUE.copy()
    still[40:52] = still[40]
    (fault,) = find_recorded_faults(_DESIGN, still)
    assert (fault.kind, fault.run) == (FaultKind.STUCK_SENSOR, int(_DESIGN.run[40]))
    assert fault.comes_first
    assert fault.statement.in_language(Language.ENGLISH).startswith(
        "12 readings one after another are the same"
    )


@pytest.mark.parametrize("count", [1, 2, 7])
def test_few_readings_show_no_fault_though_all_are_the_same(count: int) -> None:
    few = np.arange(count)
    assert _kinds(select_readings(_DESIGN, few), np.full(count, 1e-6)) == []


def test_coarse_instrument_repeats_itself_and_has_not_stood_still() -> None:
    assert _kinds(_DESIGN, np.round(noise(_DESIGN, sigma=4e-7), 6)) == []


@pytest.mark.parametrize("directions", [(1.0, -1.0), (1.0,)])
@pytest.mark.parametrize("runs", [1, 5])
def test_coarse_instrument_reads_the_same_along_a_stretch_without_error_and_has_not_stood_still(
    runs: int, directions: tuple[float, ...]
) -> None:
    whole = linear_test(41, runs)
    design = select_readings(whole, np.flatnonzero(np.isin(whole.direction, directions)))
    worn = np.maximum(design.position - 0.5, 0.0) * 1e-4 + noise(design, sigma=5e-8)
    assert _kinds(design, np.round(worn, 6)) == []


def test_run_in_another_unit_is_not_told_as_scatter_of_the_whole_too() -> None:
    (fault,) = find_recorded_faults(_DESIGN, np.where(_THIRD, 1e3 * _TRUE, _TRUE))
    assert (fault.kind, fault.run) == (FaultKind.WRONG_UNIT, 3)


def test_time_that_falls_is_a_jump_of_the_clock() -> None:
    time = _DESIGN.time.copy()
    time[60:] -= 900.0
    assert _kinds(replace(_DESIGN, time=time), _TRUE) == [(FaultKind.CLOCK_JUMP, 3)]


def test_log_that_stops_while_others_go_on_is_a_stuck_sensor() -> None:
    log = _DESIGN.conditions["axis_temperature"].copy()
    log[50:] = log[50]
    design = replace(_DESIGN, conditions={**_DESIGN.conditions, "axis_temperature": log})
    assert _kinds(design, _TRUE) == [(FaultKind.STUCK_SENSOR, None)]


def test_columns_that_hold_what_they_cannot_are_exchanged() -> None:
    logs = dict(_DESIGN.conditions)
    logs["air_pressure"], logs["air_temperature"] = logs["air_temperature"], logs["air_pressure"]
    assert _kinds(replace(_DESIGN, conditions=logs), _TRUE) == [(FaultKind.SWAPPED_COLUMNS, None)]


def test_growth_that_a_lagging_sensor_explains_as_well_does_not_stand_alone() -> None:
    lag = 600.0
    design = linear_test(11, 5)
    time = design.time
    true = 293.15 + 3.0 * -np.expm1(-time / 700.0)
    logged = 293.15 + 3.0 * (1 + (lag * np.exp(-time / lag) - 700.0 * np.exp(-time / 700.0)) / (700.0 - lag))
    design = replace(design, conditions={"axis_temperature": logged})
    deviation = 11e-6 * design.position * (true - 293.15) + noise(design, sigma=1e-7)
    found = diagnose(model_of("offset", "scale-error"), observations(design, deviation), INSTALLED)
    assert [each.kind for each in found.faults] == [FaultKind.LAGGING_SENSOR]


def _swapped() -> Design:
    return replace(_DESIGN, direction=np.where(_THIRD, -_DESIGN.direction, _DESIGN.direction))


def test_effect_of_reversed_shape_is_no_slip_of_a_run() -> None:
    """A slope that follows the air the wrong way round: runs differ, and no turned sign is to blame."""
    design = linear_test(11, 3)
    shape = hidden(design, "air-index", size=4.0, model=_MODEL)
    found = diagnose(_MODEL, observations(design, noise(design) - shape), INSTALLED)
    assert [each.identifier for each in found.together] == ["air-index"]
    assert found.faults == ()


def test_what_the_model_says_of_a_run_is_no_slip_of_it() -> None:
    """Of five runs the first has a slope of the other sign, and nearly the size, as a model knows."""
    model = model_of("offset", "scale-error", "first-run-slope")
    slope = np.where(_DESIGN.run == 1, 17e-6, -25e-6)
    deviation = slope * _DESIGN.position + noise(_DESIGN, sigma=1e-6)
    assert run_faults(fit(model_of("offset", "scale-error"), _DESIGN, deviation)) != ()
    assert run_faults(fit(model, _DESIGN, deviation)) == ()


def test_effect_of_reversed_shape_is_no_lagging_sensor() -> None:
    shape = hidden(_DESIGN, "air-index", model=_MODEL)
    found = diagnose(_MODEL, observations(_DESIGN, noise(_DESIGN, seed=0) - shape), INSTALLED)
    assert found.faults == ()


def test_temperature_that_stands_still_lags_behind_nothing() -> None:
    design = linear_test(11, 5)
    warm = replace(design, conditions={"axis_temperature": np.full(len(design.time), 298.15)})
    deviation = 14e-6 * design.position + noise(design)
    found = diagnose(model_of("offset"), observations(warm, deviation), INSTALLED)
    assert {each.identifier for each in found.candidates[:2]} == {"scale-error", "scale-expansion"}
    assert found.faults == ()


def test_a_lagging_sensor_is_known_by_the_clock_of_each_session() -> None:
    """The axis warms up in the first session and cools down in the second; both begin at 0 s."""
    lag, base = 600.0, linear_test(11, 5)
    sessions = []
    for sign, seed in ((1.0, 1), (-1.0, 2)):
        time = base.time
        course = 1 + (lag * np.exp(-time / lag) - 700.0 * np.exp(-time / 700.0)) / (700.0 - lag)
        true = 3.0 * sign * -np.expm1(-time / 700.0)
        design = replace(base, conditions={"axis_temperature": 293.15 + 3.0 * sign * course})
        deviation = 11e-6 * design.position * true + noise(design, seed=seed, sigma=1e-7)
        sessions.append(observations(design, deviation))
    both = join_sessions(sessions[0], [("second", sessions[1])])
    fitted = fit(add_zeros(model_of("offset", "scale-error"), both.design), both.design, both.deviation)
    (found,) = find_lagging_sensors(fitted, [fitted], INSTALLED)
    assert found.kind is FaultKind.LAGGING_SENSOR
    assert find_lagging_sensors(fitted, [fitted], INSTALLED, changes=1e4) == ()


def test_what_a_curve_in_time_explains_better_is_no_slip_of_a_run() -> None:
    fitted = fit(_MODEL, _swapped(), _TRUE)
    (found,) = run_faults(fitted)
    assert found.explains
    # Some 290 in units of 2·ln, on 100 of 107 degrees of freedom.
    assert [each.explains for each in run_faults(fitted, changes=200.0)] == [True]
    assert run_faults(fitted, changes=400.0) == ()


def test_what_the_model_explains_already_is_no_slip_of_a_run() -> None:
    design = linear_test(11, 3)
    wave = formula(
        "a*sin(2*pi*t/L) + b*cos(2*pi*t/L)",
        a={"unit": "um"},
        b={"unit": "um"},
        L={"unit": "s", "value": 870.0},
    )
    swing = 6e-6 * np.sin(2 * np.pi * design.time / 870.0) + noise(design, sigma=4e-7)
    # Against the wave, run 1 goes the other way about than the others.
    assert [each.run for each in run_faults(fit(_MODEL, design, swing))] == [1]
    assert run_faults(fit(model_of("offset", "scale-error", "backlash", wave), design, swing)) == ()


def test_targets_that_lie_micrometres_apart_are_not_taken_for_each_other() -> None:
    close = replace(_DESIGN, position=_DESIGN.position * 1e-4)
    assert _kinds(close, _TRUE) == []


def test_a_night_between_two_runs_parts_two_sessions() -> None:
    time = _DESIGN.time + 22 * 3600.0 * (_DESIGN.run > 3)
    (said,) = find_pauses_between_runs(replace(_DESIGN, time=time))
    assert said.in_language(Language.ENGLISH).startswith("Between run 3 and run 4 lie 22 h")
    assert not list(find_pauses_between_runs(_DESIGN))


def test_repeats_that_no_machine_has_are_asked_for_their_unit() -> None:
    quiet = 1e-6 * _DESIGN.position + noise(_DESIGN, sigma=1e-9)
    (fault,) = find_recorded_faults(_DESIGN, quiet)
    assert (fault.kind, fault.run) == (FaultKind.WRONG_UNIT, None)
    assert "millimetres" in fault.statement.in_language(Language.ENGLISH)


def test_repeats_that_no_rotary_table_has_look_like_degrees() -> None:
    design = linear_test(axis=Axis("C", AxisKind.ROTARY))
    (fault,) = find_recorded_faults(design, 1e-6 * design.position + noise(design, sigma=1e-9))
    assert fault.statement.in_language(Language.ENGLISH).endswith("as if they stood in degrees")


def test_beside_a_fault_that_is_sure_nothing_without_a_name_is_told() -> None:
    bump = 6e-6 * np.exp(-(((_DESIGN.position - 0.4) / 0.05) ** 2))
    found = diagnose(_MODEL, observations(_swapped(), _TRUE + bump), INSTALLED)
    assert found.faults[0].comes_first
    assert found.remainder is None


def test_a_run_that_stands_off_from_all_others_is_no_noise() -> None:
    design = linear_test()
    sigma = 0.7e-6
    deviation = noise(design, sigma=sigma) + 2 * sigma * (design.run == 3)
    found = diagnose(_MODEL, observations(design, deviation), INSTALLED)
    assert found.verdict is not DiagnosisVerdict.ADEQUATE
    (displaced,) = found.together
    assert displaced.identifier == "run-displaced"
    values = {each.parameter.name: each.value for each in found.candidates[0].estimates}
    assert values["which"] == 3
    assert values["step"] == pytest.approx(2 * sigma, abs=sigma / 2)
