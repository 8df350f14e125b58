"""Effects that may stand in a model more than once: a scale has more than one joint."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import zlmreport as z
from model.axis_tests import EFFECTS, INSTALLED, linear_test, model_of, noise, observations
from zlmreport.cli import main
from zlmreport.language import Language
from zlmreport.model.diagnosis.building import build, name_changes, name_steps
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.effects_to_try import list_effects_to_try
from zlmreport.model.diagnosis.report import build_values
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import Axis, AxisKind, InputError
from zlmreport.plugin.registry import find_plugins

_DESIGN = linear_test(21, 5)
_TARGETS = _DESIGN.target_positions
_GAPS = (_TARGETS[:-1] + _TARGETS[1:]) / 2
_FIRST, _SECOND = _GAPS[5], _GAPS[14]
_DEVIATION = (
    4e-6 * (_DESIGN.position > _FIRST) - 6e-6 * (_DESIGN.position > _SECOND) + noise(_DESIGN, sigma=4e-7)
)
_JOINT = EFFECTS["scale-joint"]


def test_two_joints_are_found_side_by_side() -> None:
    found = fit(model_of("offset", "scale-joint", _JOINT.repeated(2)), _DESIGN, _DEVIATION)
    values = {(each.effect, each.parameter.name): each.value for each in found.estimates}
    names = ("scale-joint", "scale-joint-2")
    joints = sorted((values[name, "joint"], values[name, "step"]) for name in names)
    assert [place for place, _ in joints] == pytest.approx([_FIRST, _SECOND])
    assert [step for _, step in joints] == pytest.approx([4e-6, -6e-6], abs=4e-7)


def test_what_stands_beside_both_joints_is_no_equal_of_the_second() -> None:
    design = linear_test(41, 3)
    joints = 12e-6 * (design.position > 0.35) - 9e-6 * (design.position > 0.7)
    straight = -25e-6 * design.position + 15e-6 * design.direction
    observed = observations(design, straight + joints + noise(design, sigma=2e-6))
    names = ("scale-error", "backlash", "scale-joint")
    found = diagnose(model_of("offset", *names), observed, INSTALLED, may_go=frozenset(names))
    assert [(each.identifier, each.equals) for each in found.candidates] == [("scale-joint-2", ())]


def test_the_next_joint_is_tried_beside_the_first() -> None:
    forms = list_effects_to_try(model_of("offset", "scale-joint"), _DESIGN, INSTALLED).forms
    tried = {form.identifier for form in forms}
    assert {"scale-joint-2", "scale-kink"} <= tried
    assert "scale-joint" not in tried


@pytest.mark.parametrize(("runs", "size"), [(6, 20.0), (7, 100.0)])
def test_two_displaced_runs_are_found_together_where_a_curve_that_displaces_all_does_more_than_one(
    runs: int, size: float
) -> None:
    random, gap = np.random.default_rng(runs), 2.0
    displaced = np.zeros((runs, 1))
    displaced[1], displaced[runs - 2] = size, -0.8 * size
    up, down = (random.normal(half, 1.0, (runs, 11)) + displaced for half in (-gap, gap))
    diagnosis = z.fit(z.test(np.linspace(0, 500, 11), up, down), ["offset", "backlash"]).diagnose().to_dict()
    assert (diagnosis["set"], diagnosis["remainder"]) == (["run-displaced", "run-displaced-2"], None)
    assert not [each for each in diagnosis["visibility"] if each["effect"].endswith("-2")]


def test_of_two_displaced_runs_that_are_not_sure_each_goes_by_itself() -> None:
    """Both have one name: a set with both was taken for the set with one, without end."""
    random, displaced = np.random.default_rng([10, 7, 1, 5]), np.zeros((7, 1))
    displaced[1], displaced[5] = 10.0, -8.0
    up, down = random.normal(0, 1, (7, 11)) - 2, random.normal(0, 1, (7, 11)) + 2
    test = z.test(np.linspace(0, 500, 11), up + displaced, down + displaced)
    diagnosis = z.fit(test, ["offset", "backlash"]).diagnose().to_dict()
    assert diagnosis["remainder"]["shape"] == "every run displaced as a whole"


def test_search_for_the_second_begins_at_another_place() -> None:
    first, second = _JOINT.grid(_DESIGN), _JOINT.repeated(2).grid(_DESIGN)
    assert first[0] != second[0]  # else nothing would tell the two apart where a model is checked
    assert len(second) == len(first) - 1


def test_effect_that_may_stand_there_once_stays_what_it_is() -> None:
    assert EFFECTS["backlash"].repeated(2) is EFFECTS["backlash"]


def test_registry_knows_the_second_by_its_number() -> None:
    registry = find_plugins()
    assert registry.effect("scale-joint-2").identifier == "scale-joint-2"
    with pytest.raises(InputError, match="backlash-2"):
        registry.effect("backlash-2")


_JOB = """schema: zlmreport/job/1
certificate: {number: JOINTS-1, kind: report}
axis: {name: X, travel: [0, 1000]}
measurement: {source: {plugin: laser-csv, file: x.csv}}
evaluate: [iso230-2:2014]
model:
  effects:
    - offset
    - scale-joint
"""


@pytest.fixture
def job(tmp_path: Path) -> Path:
    rows = zip(_DESIGN.position * 1e3, _DESIGN.direction, _DESIGN.run, _DEVIATION * 1e6, strict=True)
    lines = ["target,direction,run,deviation", *(",".join(f"{each:.9g}" for each in row) for row in rows)]
    (tmp_path / "x.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    path = tmp_path / "job.yaml"
    path.write_text(_JOB, encoding="utf-8")
    return path


def _effects(job: Path, capsys: pytest.CaptureFixture[str]) -> list[str]:
    capsys.readouterr()
    assert main(["model", "fit", str(job), "--json"]) == 0
    found: list[str] = json.loads(capsys.readouterr().out)["model"]["effects"]
    return found


def test_joint_is_added_a_second_time(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "add", str(job), "scale-joint"]) == 0
    assert "+ scale-joint-2" in capsys.readouterr().out
    assert job.read_text(encoding="utf-8").endswith("    - scale-joint\n    - scale-joint-2\n")
    assert _effects(job, capsys) == ["offset", "scale-joint", "scale-joint-2"]
    assert main(["model", "remove", str(job), "scale-joint-2"]) == 0
    assert _effects(job, capsys) == ["offset", "scale-joint"]


def test_job_may_list_a_joint_twice(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    job.write_text(_JOB + "    - scale-joint: {joint: 730}\n", encoding="utf-8")
    assert _effects(job, capsys) == ["offset", "scale-joint", "scale-joint-2"]


def test_second_backlash_is_still_refused(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    job.write_text(_JOB.replace("scale-joint", "backlash"), encoding="utf-8")
    assert main(["model", "add", str(job), "backlash"]) == 2
    assert "backlash stands in the model already" in capsys.readouterr().err


def test_notebook_adds_a_second_joint() -> None:
    up, down = (
        _DEVIATION[_DESIGN.direction == sign].reshape(5, 21)[:, :: int(sign)] * 1e6 for sign in (1.0, -1.0)
    )
    model = z.fit(z.test(_TARGETS * 1e3, up, down), ["offset", "scale-joint"])
    assert model.add("scale-joint").effects == ("offset", "scale-joint", "scale-joint-2")


def test_period_that_the_data_contradict_is_tried_as_another_form_of_the_screw() -> None:
    effect = EFFECTS["screw-pitch"]
    other = effect.with_settings(effect.options(harmonics=(1,), pitch="other"))
    assert other.settings in [form.settings for form in effect.forms()]
    deviation = 4e-6 * np.sin(2 * np.pi * _DESIGN.position / 0.012) + noise(_DESIGN, sigma=4e-7)
    found = fit(model_of("offset", other), _DESIGN, deviation)
    period = next(each for each in found.estimates if each.parameter.name == "period")
    assert period.value == pytest.approx(0.012, rel=1e-3)
    assert effect.expected(_DESIGN.axis) == {"period": 0.01}


def test_harmonics_of_another_pitch_are_tried_where_it_stands_in_the_model() -> None:
    effect = EFFECTS["screw-pitch"]
    other = effect.with_settings(effect.options(harmonics=(1,), pitch="other"))
    assert effect.options(harmonics=(1, 2, 3, 4), pitch="other") in [
        form.settings for form in other.further_forms()
    ]


def test_a_build_adds_the_harmonic_of_another_pitch() -> None:
    large, small = (np.sin(2 * np.pi * _DESIGN.position / each + 1) for each in (0.012, 0.006))
    observed = observations(_DESIGN, 4e-6 * large + 1.2e-6 * small + noise(_DESIGN, sigma=4e-7))
    built = build(
        model_of("offset"),
        lambda model, may_go, told: diagnose(model, observed, INSTALLED, may_go=may_go, told=told),
    )
    (pitch,) = (each.effect for each in built.model.terms if each.effect.identifier == "screw-pitch")
    assert pitch.settings.model_dump() == {"harmonics": (1, 2), "pitch": "other"}
    assert built.last.verdict is DiagnosisVerdict.ADEQUATE
    assert name_steps(built.steps) == ("+ screw-pitch", "screw-pitch in another form")
    assert [each.get("reshaped", False) for each in build_values(built)["steps"]] == [False, True]
    assert name_changes(built) == ("+ screw-pitch",)


def test_nothing_that_counts_from_the_stated_pitch_stands_beside_another() -> None:
    # A wave of 6 mm is 1.67 waves in a turn of a screw of 10 mm, and the second harmonic of one of 12 mm.
    effect = EFFECTS["screw-pitch"]
    other = effect.with_settings(effect.options(harmonics=(1,), pitch="other"))
    tried = list_effects_to_try(model_of("offset", other), _DESIGN, INSTALLED)
    assert "drive-period" not in {each.identifier for each in tried.forms}
    (reason,) = (each.reason for each in tried.not_testable if each.effect == "drive-period")
    assert (
        reason.in_language(Language.ENGLISH)
        == "screw-pitch has another value than the job states under axis.screw_pitch"
    )


def test_other_pitches_are_none_that_the_stated_one_has_as_a_harmonic() -> None:
    effect = EFFECTS["screw-pitch"]
    other = effect.with_settings(effect.options(pitch="other"))
    tried = set(np.round(other.grid(_DESIGN)[:, 0] * 1e3, 6))
    assert {12.0, 8.0, 20.0, 25.4} <= tried
    assert not {10.0, 5.0, 2.5} & tried


def test_usual_pitches_are_tried_where_the_job_states_none() -> None:
    effect, silent = EFFECTS["screw-pitch"], replace(_DESIGN, axis=replace(_DESIGN.axis, screw_pitch=None))
    other = effect.with_settings(effect.options(pitch="other"))
    assert other.untestable(silent) is None
    assert {2.0, 5.0, 10.0, 25.4} <= set(np.round(other.grid(silent)[:, 0] * 1e3, 6))
    assert effect.untestable(silent) is not None


def test_no_other_teeth_are_tried_where_the_job_states_no_pitch() -> None:
    """All whole numbers are searched then."""
    effect = EFFECTS["gear-mesh"]
    other = effect.with_settings(effect.options(number="other"))
    turn = 2 * np.pi
    table = Axis("C", kind=AxisKind.ROTARY, travel=(0.0, turn))
    silent = linear_test(axis=table, places=np.linspace(0.0, turn, 21, endpoint=False))
    assert effect.untestable(silent) is None
    assert other.untestable(silent) is not None
