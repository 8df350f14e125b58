"""A parameter of an effect, and a reading set aside, are written into a job and taken out again."""

from __future__ import annotations

from pathlib import Path

import pytest

from installed import registry
from zlmreport.job.edit_items import ParameterChoice, edit_parameter, exclude, include
from zlmreport.job.loading import load
from zlmreport.job.measurement_keys import ExclusionKeys
from zlmreport.plugin import InputError

HEAD = """\
schema: zlmreport/job/1
certificate: {number: CAL-1, kind: report}  # a remark
axis: {name: X}
"""
MEASUREMENT = """\
measurement:
  source: {plugin: laser-csv, file: x-axis.csv}
  feed: 2000  # mm/min
"""
TAIL = "evaluate: [nmtba]\n"
REASON = "Air hose: touched #2"
EXCLUSION = ExclusionKeys(target=213.4, direction="-", run=3, reason=REASON)
WRITTEN = '{target: 213.4, direction: "-", run: 3, reason: "Air hose: touched #2"}'


def job(folder: Path, text: str) -> Path:
    path = folder / "job.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def with_parameter(path: Path, effect: str, name: str, value: float | None) -> str:
    edit_parameter(path, load(path, registry()), registry(), ParameterChoice(effect, name, value)).write()
    return path.read_text(encoding="utf-8").removeprefix(HEAD + MEASUREMENT + TAIL)


FIXED = {
    "a name becomes a key": (
        "model:\n  effects:\n    - offset  # zero\n    - backlash  # play\n",
        "model:\n  effects:\n    - offset  # zero\n    - backlash: {lost_motion: -4}  # play\n",
    ),
    "a value is replaced": (
        "model:\n  effects:\n    - backlash: {lost_motion: 2}\n",
        "model:\n  effects:\n    - backlash: {lost_motion: -4}\n",
    ),
    "in brackets": (
        "model: {effects: [offset, backlash]}\n",
        "model: {effects: [offset, {backlash: {lost_motion: -4}}]}\n",
    ),
    "keys a line": (
        "model:\n  effects:\n    - backlash:\n        lost_motion: 2\n    - offset\n",
        "model:\n  effects:\n    - backlash: {lost_motion: -4}\n    - offset\n",
    ),
}


@pytest.mark.parametrize(("before", "after"), FIXED.values(), ids=FIXED)
def test_a_parameter_is_fixed_where_its_effect_stands(tmp_path: Path, before: str, after: str) -> None:
    path = job(tmp_path, HEAD + MEASUREMENT + TAIL + before)
    assert with_parameter(path, "backlash", "lost_motion", -4.0) == after


def test_a_parameter_that_is_freed_leaves_the_name_alone(tmp_path: Path) -> None:
    path = job(tmp_path, HEAD + MEASUREMENT + TAIL + "model: {effects: [{backlash: {lost_motion: 2}}]}\n")
    assert with_parameter(path, "backlash", "lost_motion", None) == "model: {effects: [backlash]}\n"


def test_the_other_keys_of_the_effect_stay(tmp_path: Path) -> None:
    path = job(tmp_path, HEAD + MEASUREMENT + TAIL + "model: {effects: [{polynomial: {order: 2}}]}\n")
    fixed = with_parameter(path, "polynomial", "c1", 3.0)
    assert fixed == "model: {effects: [{polynomial: {order: 2, c1: 3}}]}\n"
    assert with_parameter(path, "polynomial", "c1", None) == "model: {effects: [{polynomial: {order: 2}}]}\n"


def test_a_comment_within_the_effect_is_never_lost(tmp_path: Path) -> None:
    path = job(
        tmp_path,
        HEAD
        + MEASUREMENT
        + TAIL
        + "model:\n  effects:\n    - backlash:\n        # why\n        lost_motion: 2\n",
    )
    with pytest.raises(InputError, match="write it by hand"):
        with_parameter(path, "backlash", "lost_motion", -4.0)


@pytest.mark.parametrize(("effect", "name"), [("backlash", "gain"), ("offset", "offset")])
def test_a_parameter_that_the_model_has_not_is_refused(tmp_path: Path, effect: str, name: str) -> None:
    path = job(tmp_path, HEAD + MEASUREMENT + TAIL + "model: {effects: [backlash]}\n")
    with pytest.raises(InputError, match=f"no parameter '{effect}.{name}'"):
        with_parameter(path, effect, name, 1.0)


LAYOUTS = {
    "keys a line": (MEASUREMENT, f"{MEASUREMENT}  excluded:\n    - {WRITTEN}\n"),
    "in braces": (
        "measurement: {source: {plugin: laser-csv, file: x.csv}}\n",
        f"measurement: {{source: {{plugin: laser-csv, file: x.csv}}, excluded: [{WRITTEN}]}}\n",
    ),
    "an empty list": (
        f"{MEASUREMENT}  excluded: []  # none\n",
        f"{MEASUREMENT}  excluded: [{WRITTEN}]  # none\n",
    ),
}


@pytest.mark.parametrize(("before", "after"), LAYOUTS.values(), ids=LAYOUTS)
def test_a_reading_is_set_aside_in_any_layout(tmp_path: Path, before: str, after: str) -> None:
    path = job(tmp_path, HEAD + before + TAIL)
    exclude(path, load(path, registry()), registry(), [EXCLUSION]).write()
    assert path.read_text(encoding="utf-8") == HEAD + after + TAIL
    assert load(path, registry()).keys.measurement.excluded == [EXCLUSION]


def test_a_reading_comes_back_and_the_others_stay_aside(tmp_path: Path) -> None:
    path = job(tmp_path, HEAD + MEASUREMENT + TAIL)
    other = EXCLUSION.model_copy(update={"run": 4})
    for each in (EXCLUSION, other):
        exclude(path, load(path, registry()), registry(), [each]).write()
    include(path, load(path, registry()), registry(), 0).write()
    assert load(path, registry()).keys.measurement.excluded == [other]


def test_the_list_of_a_file_that_is_extended_is_written_into_the_job(tmp_path: Path) -> None:
    (tmp_path / "base.yaml").write_text(f"{MEASUREMENT}  excluded: [{WRITTEN}]\n", encoding="utf-8")
    path = job(tmp_path, f"{HEAD}extends: base.yaml\n{TAIL}")
    edit = exclude(path, load(path, registry()), registry(), [EXCLUSION.model_copy(update={"run": 4})])
    edit.write()
    assert [each.run for each in load(path, registry()).keys.measurement.excluded] == [3, 4]
    assert edit.inherited_from.endswith("base.yaml")


def test_a_reading_is_set_aside_at_a_target_of_many_digits(tmp_path: Path) -> None:
    path = job(tmp_path, HEAD + MEASUREMENT + TAIL)
    aside = EXCLUSION.model_copy(update={"target": 103.132403123548})
    exclude(path, load(path, registry()), registry(), [aside]).write()
    assert load(path, registry()).keys.measurement.excluded == [aside]


def test_a_parameter_is_fixed_with_every_digit(tmp_path: Path) -> None:
    path = job(tmp_path, f"{HEAD}{MEASUREMENT}{TAIL}model: {{effects: [backlash]}}\n")
    with_parameter(path, "backlash", "lost_motion", 4.123456789012)
    assert load(path, registry()).effects[0].values == {"lost_motion": 4.123456789012}
