"""A job file is edited in place, or left as it is."""

from __future__ import annotations

import codecs
from pathlib import Path

import pytest

from installed import registry
from zlmreport import ZlmreportError
from zlmreport.job.edit import Edit, edit_effects, read_named_effect
from zlmreport.job.loading import load
from zlmreport.plugin import AccessError, InputError, Place

HEAD = """\
schema: zlmreport/job/1
certificate: {number: CAL-1, kind: report}  # a remark
axis: {name: X}
measurement:
  source: {plugin: laser-csv, file: x-axis.csv}
evaluate: [nmtba]
"""
MODEL = """\
model:
  effects:
    - offset  # the zero
    - backlash: {lost_motion: 4.0}
"""


@pytest.fixture
def job(tmp_path: Path) -> Path:
    path = tmp_path / "job.yaml"
    path.write_text(HEAD + MODEL, encoding="utf-8")
    return path


def edited(path: Path, add: str = "", *, remove: tuple[str, ...] = ()) -> Edit:
    """Return the change of a job that somebody asks for on the command line."""
    named = [read_named_effect(add, registry(), Place("command"))] if add else []
    return edit_effects(path, load(path, registry()), registry(), add=named, remove=remove)


def effects(path: Path) -> list[str]:
    return [choice.identifier for choice in load(path, registry()).effects]


def message(add: str) -> str:
    with pytest.raises(ZlmreportError) as caught:
        read_named_effect(add, registry(), Place("command"))
    return str(caught.value)


def test_an_effect_is_written_into_the_job(job: Path) -> None:
    edited(job, "first-run").write()
    assert job.read_text(encoding="utf-8") == f"{HEAD}{MODEL}    - first-run\n"


def test_an_effect_is_taken_out_of_the_job(job: Path) -> None:
    edited(job, remove=("backlash",)).write()
    assert job.read_text(encoding="utf-8") == f"{HEAD}model:\n  effects:\n    - offset  # the zero\n"


def test_an_effect_may_take_the_place_of_others(job: Path) -> None:
    edited(job, "polynomial: {order: 5}", remove=("offset",)).write()
    assert job.read_text(encoding="utf-8").endswith(
        "effects:\n    - backlash: {lost_motion: 4.0}\n    - polynomial: {order: 5}\n"
    )


def test_nothing_is_written_before_it_is_asked_for(job: Path) -> None:
    change = edited(job, "first-run")
    assert effects(job) == ["offset", "backlash"]
    assert [choice.identifier for choice in change.job.effects] == ["offset", "backlash", "first-run"]


def test_a_byte_order_mark_stays(job: Path) -> None:
    job.write_bytes(codecs.BOM_UTF8 + job.read_bytes())
    edited(job, "first-run").write()
    assert job.read_bytes().startswith(codecs.BOM_UTF8 + b"schema")
    assert effects(job)[-1] == "first-run"


def test_permissions_stay(job: Path) -> None:
    job.chmod(0o640)
    edited(job, "first-run").write()
    assert job.stat().st_mode & 0o777 == 0o640


def test_a_link_stays_a_link(job: Path, tmp_path: Path) -> None:
    link = tmp_path / "linked" / "job.yaml"
    link.parent.mkdir()
    link.symlink_to(job)
    edited(link, "first-run").write()
    assert link.is_symlink()
    assert effects(job)[-1] == "first-run"


def test_no_other_file_is_left_behind(job: Path) -> None:
    edited(job, "first-run").write()
    assert list(job.parent.iterdir()) == [job]


@pytest.mark.parametrize("is_written", [False, True], ids=["before the edit", "before the writing"])
def test_a_file_that_somebody_else_changed_is_left_as_it_is(job: Path, *, is_written: bool) -> None:
    loaded = load(job, registry())
    change = edited(job, "first-run")
    job.write_text(f"{HEAD}# theirs\n{MODEL}", encoding="utf-8")
    with pytest.raises(InputError, match="changed by somebody else"):
        change.write() if is_written else edit_effects(job, loaded, registry(), remove=["offset"])
    assert "# theirs" in job.read_text(encoding="utf-8")
    assert list(job.parent.iterdir()) == [job]


def test_a_file_that_cannot_be_written_is_an_access_error(job: Path) -> None:
    change = edited(job, "first-run")
    job.unlink()
    with pytest.raises(AccessError, match="cannot be written"):
        change.write()


def test_inherited_effects_are_written_into_the_job_itself(job: Path) -> None:
    own = job.with_name("own.yaml")
    own.write_text("extends: job.yaml\n# mine\n", encoding="utf-8")
    change = edited(own, "first-run")
    change.write()
    assert change.inherited_from == str(job)
    assert own.read_text(encoding="utf-8") == (
        "extends: job.yaml\n# mine\nmodel:\n  effects:\n    - offset\n    - backlash: {lost_motion: 4.0}\n"
        "    - first-run\n"
    )
    assert effects(job) == ["offset", "backlash"]


def test_the_last_inherited_effect_can_be_taken_out(job: Path) -> None:
    own = job.with_name("own.yaml")
    own.write_text("extends: job.yaml\n", encoding="utf-8")
    edited(own, remove=("offset", "backlash")).write()
    assert own.read_text(encoding="utf-8") == "extends: job.yaml\nmodel:\n  effects: []\n"


def test_own_effects_are_not_inherited(job: Path) -> None:
    assert edited(job, "first-run").inherited_from == ""


def test_a_model_that_other_values_may_refer_to_is_edited_where_it_stands(job: Path) -> None:
    job.write_text(f"{HEAD}model: &m {{effects: [&x offset]}}\n", encoding="utf-8")
    edited(job, "first-run").write()
    assert job.read_text(encoding="utf-8").endswith("model: &m {effects: [&x offset, first-run]}\n")


def test_what_other_values_refer_to_is_not_taken_out(job: Path) -> None:
    listed = "    - screw-pitch: &x {harmonics: [1]}\n    - encoder-interpolation: *x\n"
    job.write_text(f"{HEAD}model:\n  effects:\n{listed}", encoding="utf-8")
    with pytest.raises(InputError, match=r"write it by hand: effects: \[\{encoder-") as caught:
        edited(job, remove=("screw-pitch",))
    assert caught.value.problems[0].place == Place(str(job), 8, 3)


def test_an_unknown_effect_is_answered_with_the_nearest() -> None:
    assert "did you mean 'screw-pitch'?" in message("screwpitch")


def test_an_unknown_key_is_answered_with_the_nearest() -> None:
    assert "unknown key 'ordr' in model.effects.polynomial; did you mean 'order'?" in message(
        "polynomial: {ordr: 5}"
    )


def test_mistakes_stand_at_the_place_that_names_the_effect() -> None:
    assert message("screwpitch").startswith("command: ")


def test_an_effect_is_named_as_in_a_job() -> None:
    named = read_named_effect("polynomial: {order: 5}", registry(), Place("command"))
    assert (named.choice.identifier, named.choice.settings.model_dump()) == ("polynomial", {"order": 5})
