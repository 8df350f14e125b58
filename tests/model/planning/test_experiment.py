"""The plan that tells effects apart: simulated, within the travel, and right when it is followed."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from environments import ROOT
from model.axis_tests import EFFECTS, INSTALLED, noise
from model.planning.planned import REGISTRY, WHOLE_PITCHES, planned_job
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.model.diagnosis.diagnosis import diagnose
from zlmreport.model.diagnosis.study import Study
from zlmreport.model.fitting.observations import Observations
from zlmreport.model.planning.deciding import (
    collect_experiment,
    plan_deciding_experiment,
    plan_experiment_of_tie,
    write_deciding_text,
)
from zlmreport.model.planning.experiment import Experiment, choose_option, rank_option
from zlmreport.model.planning.methods import Method, find_half_way
from zlmreport.model.planning.plan import AxisPlan, ExpectedTest, Pause, propose
from zlmreport.model.planning.planned_test import choose_model_of
from zlmreport.model.planning.programs import plan_motion_of
from zlmreport.model.planning.visibility import expect_design
from zlmreport.plugin import InputError, Language

ON_WHOLE_PITCHES = ("plan: {}", WHOLE_PITCHES)
ROOM_AT_THE_ENDS = ("[0, 600]", "[-10, 610]")
#: Both follow the position alone at a constant temperature.
COOL = ("plan: {}", "plan: {temperature_change: 0.01}")


@cache
def _experiment(names: str, *changes: tuple[str, str]) -> Experiment:
    job = planned_job(*changes)
    standards = pipeline.choose_standards(job, REGISTRY)
    return plan_deciding_experiment(names.split(","), job, None, REGISTRY.effects, standards)


def _said(experiment: Experiment) -> str:
    return experiment.statement.in_language(Language.ENGLISH)


def test_targets_on_whole_pitches_are_changed_to_tell_a_wave_of_the_pitch() -> None:
    found = _experiment("screw-pitch,scale-kink", ON_WHOLE_PITCHES, ROOM_AT_THE_ENDS)
    assert found.plan is not None
    assert found.decides >= 0.9
    phases = np.mod(found.plan.targets, 0.01)
    assert np.ptp(phases) > 0.005
    assert "random fraction" in _said(found)


@pytest.mark.long
def test_constant_temperature_is_changed_to_tell_expansion_from_a_wrong_scale() -> None:
    found = _experiment("scale-error,scale-expansion", COOL)
    assert found.plan is not None
    assert found.plan.pause is not None
    assert found.decides >= 0.95
    assert "axis_temperature" in found.logs
    assert found.minutes == pytest.approx(found.plan.duration / 60)


@pytest.mark.parametrize("truth", ["scale-error", "scale-expansion"])
def test_who_follows_the_advice_learns_the_truth(truth: str) -> None:
    found = _experiment("scale-error,scale-expansion", COOL)
    assert found.plan is not None
    job = planned_job(COOL)
    design = expect_design(job.axis, found.plan, ExpectedTest(1e-6, 0.01))
    columns = EFFECTS[truth].columns(design, np.empty(0))
    deviation = 3e-6 * columns[:, 0] / np.std(columns[:, 0]) + noise(design, 5, 1e-6)
    model = choose_model_of(job, INSTALLED).without("scale-error")
    readings = np.arange(len(deviation))
    leading = diagnose(model, Observations(design, deviation, readings, ()), INSTALLED).candidates[0]
    named = {leading.identifier, *leading.equals}
    assert truth in named
    assert not named & ({"scale-error", "scale-expansion"} - {truth})


@pytest.mark.parametrize(
    ("decides", "chosen"),
    [
        ((0.74, 0.76), 0),  # so many simulated tests do not tell the two apart
        ((0.60, 0.76), 1),
        ((0.94, 0.96), 1),  # the one is taken to decide, the other is not
        ((0.96, 0.99), 0),
    ],
)
def test_longer_plan_is_advised_where_it_decides_more_often(
    decides: tuple[float, float], chosen: int
) -> None:
    options = [
        SimpleNamespace(decides=each, plan=SimpleNamespace(duration=minutes * 60.0))
        for each, minutes in zip(decides, (25, 45), strict=True)
    ]
    assert choose_option(options) is options[chosen]


def test_of_plans_that_decide_as_often_the_one_with_more_evidence_is_the_surest() -> None:
    """Where no simulated test decides, evidence alone tells which changes are worth trying together."""
    never, nearly, often = (
        SimpleNamespace(decides=decides, margin=margin)
        for decides, margin in ((0.0, -4.0), (0.0, -0.5), (0.6, -2.0))
    )
    assert sorted([never, nearly, often], key=rank_option) == [often, nearly, never]


@pytest.mark.long
def test_experiment_of_what_a_diagnosis_leaves_open_is_the_one_that_it_states() -> None:
    path = ROOT / "configs" / "second-test" / "cool.yaml"
    job = load(path, REGISTRY)
    study = Study.of(job, pipeline.read(job, REGISTRY), REGISTRY.effects)
    stated = plan_experiment_of_tie(study, study.diagnose(REGISTRY.effects), REGISTRY.effects)
    assert stated is not None
    assert len(stated.effects) > 1
    standards = pipeline.choose_standards(job, REGISTRY)
    asked = plan_deciding_experiment(stated.effects[::-1], job, study, REGISTRY.effects, standards)
    assert _said(asked) == _said(stated)


def test_what_no_plan_decides_is_said_with_what_would() -> None:
    found = _experiment("scale-error,cosine-error")
    assert found.plan is None
    assert found.decides < 0.5
    assert "To tell scale-error and cosine-error apart: none of the" in _said(found)
    assert "align the beam anew" in _said(found)
    job = planned_job()
    assert collect_experiment(found, job, Language.ENGLISH)["job"] is None


def test_a_wave_that_whole_pitches_hide_is_shown_by_other_phases() -> None:
    found = _experiment("screw-pitch", ON_WHOLE_PITCHES, ROOM_AT_THE_ENDS)
    assert found.plan is not None
    assert found.decides >= 0.95
    assert np.ptp(np.mod(found.plan.targets, 0.01)) > 0.005
    assert _said(found).startswith("To show screw-pitch: ")


def test_an_expansion_that_a_steady_temperature_hides_is_shown_by_a_change_of_temperature() -> None:
    found = _experiment("scale-expansion", COOL)
    assert found.plan is not None
    assert found.decides >= 0.95
    assert found.plan.pause is not None


def test_what_no_plan_shows_is_said() -> None:
    found = _experiment("cosine-error")
    assert found.plan is None
    assert _said(found).startswith("To show cosine-error: none of the")


def test_an_effect_that_the_job_leaves_untestable_is_said_with_what_is_missing() -> None:
    found = _experiment("encoder-interpolation")
    assert found.plan is None
    assert "encoder-interpolation: the job does not state axis.signal_period." in _said(found)


def test_experiment_stays_within_the_travel() -> None:
    for names in ("scale-error,scale-expansion", "backlash,reversal-relaxation"):
        plan = _experiment(names, COOL).plan
        assert plan is not None
        assert all(0 <= stop.position <= 0.6 for stop in plan.stops)


@pytest.mark.parametrize(
    "plan",
    [
        "{overrun: 400, targets: {positions: [0, 60, 130, 210, 300, 420, 600]}}",  # no room to turn round
        "{overrun: 250, targets: {positions: [0, 30, 60, 100, 130, 170, 200]}}",  # all beside one end
    ],
)
def test_an_overrun_that_leaves_no_room_does_not_stop_the_experiment(plan: str) -> None:
    found = _experiment("backlash", ("plan: {}", f"plan: {plan}")).plan
    assert found is not None
    assert all(0 <= stop.position <= 0.6 for stop in found.stops)


def test_job_of_an_experiment_is_planned_as_it_was_simulated(tmp_path: Path) -> None:
    found = _experiment("scale-error,scale-expansion", COOL)
    assert found.plan is not None
    path = tmp_path / "job.yaml"
    job = planned_job(COOL)
    assert job.files[0].content is not None
    path.write_bytes(job.files[0].content)
    decide = tmp_path / "decide.yaml"
    decide.write_text(write_deciding_text(found, job, "job.yaml"), encoding="utf-8")
    planned = propose(load(decide, REGISTRY), ()).plan
    np.testing.assert_allclose(planned.targets, found.plan.targets, atol=1e-12)
    assert (planned.method, planned.runs, planned.pause) == (
        found.plan.method,
        found.plan.runs,
        found.plan.pause,
    )
    assert planned.duration == pytest.approx(found.plan.duration)


@pytest.mark.parametrize(
    ("names", "message"),
    [
        ("scale-error,scale-error", "name an effect, or several once each"),
        ("scale-error,scale-expantion", "did you mean 'scale-expansion'"),
    ],
)
def test_names_that_make_no_question_are_refused(names: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        _experiment(names)


def test_pause_lies_between_the_halves_of_the_runs() -> None:
    plan = AxisPlan(np.array([0.1, 0.3]), runs=3, pause=Pause(600.0, 3.0, "axis_temperature"))
    visits = plan.visits
    assert [visit.run for visit in visits[find_half_way(visits) :]] == [2] * 4 + [3] * 4
    design = expect_design(planned_job().axis, plan, ExpectedTest(1e-6, 0.0))
    without = expect_design(planned_job().axis, AxisPlan(plan.targets, runs=3), ExpectedTest(1e-6, 0.0))
    np.testing.assert_allclose(design.time - without.time, [0.0] * 4 + [600.0] * 8)
    change = design.conditions["axis_temperature"] - without.conditions["axis_temperature"]
    np.testing.assert_allclose(change, [0.0] * 4 + [3.0] * 8)
    air = design.conditions["air_temperature"] - without.conditions["air_temperature"]
    np.testing.assert_allclose(air, [0.0] * 4 + [1.0] * 8)


def test_pause_needs_two_runs_one_after_another() -> None:
    paused = ("plan: {}", "plan: {pause: {minutes: 60, change: 3}}")
    with pytest.raises(InputError, match=r"job.yaml:9:8: plan.pause lies between two runs"):
        propose(planned_job(paused, ("method: linear", "method: pendulum")), ())


def test_programs_wait_in_the_pause() -> None:
    plan = AxisPlan(np.array([0.1, 0.3]), runs=2, pause=Pause(600.0, 3.0, "axis_temperature"))
    job = planned_job()
    motion = plan_motion_of("P", job.axis, plan, job.place_of("plan"))
    assert [stop.begins for stop in motion.stops if stop.begins] == ["test", "second half"]
    assert plan.method is Method.LINEAR
