"""What a job does not state is written into it, where it belongs, and nothing else changes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from installed import registry
from zlmreport.job.edit import Edit
from zlmreport.job.edit_items import edit_keys
from zlmreport.job.loading import load
from zlmreport.plugin import InputError

HEAD = "schema: zlmreport/job/1\ncertificate: {number: CAL-1, kind: report}  # a remark\n"
PITCH = {"axis.screw_pitch": 10.0}
TAIL = "measurement: {source: {plugin: laser-csv, file: x.csv}}\nevaluate: [nmtba]\n"


def edited(folder: Path, axis: str, stated: Mapping[str, float | str] = PITCH, unit: str = "mm") -> Edit:
    path = folder / "job.yaml"
    path.write_text(HEAD + axis + TAIL, encoding="utf-8", newline="")
    return edit_keys(path, load(path, registry()), registry(), stated, dict.fromkeys(stated, unit))


LAYOUTS = {
    "in braces": ("axis: {name: X} # long\n", "axis: {name: X, screw_pitch: 10} # long\n"),
    "keys a line": (
        "axis:\n  name: X\n  travel: [0, 600] # mm\n",
        "axis:\n  name: X\n  travel: [0, 600] # mm\n  screw_pitch: 10 # mm\n",
    ),
    "lines that end as elsewhere": (
        "axis:\r\n    name: X\r\n",
        "axis:\r\n    name: X\r\n    screw_pitch: 10 # mm\r\n",
    ),
}


@pytest.mark.parametrize(("before", "after"), LAYOUTS.values(), ids=LAYOUTS)
def test_a_pitch_is_stated_in_any_layout(tmp_path: Path, before: str, after: str) -> None:
    edit = edited(tmp_path, before)
    assert edit.content.decode() == (HEAD + after + TAIL)
    assert edit.job.axis.screw_pitch == pytest.approx(0.01)


def test_a_rotary_axis_states_degrees(tmp_path: Path) -> None:
    edit = edited(tmp_path, "axis:\n  name: C\n  kind: rotary\n", {"axis.screw_pitch": 2.5}, "°")
    assert "screw_pitch: 2.5 # °\n".encode() in edit.content


def test_several_keys_are_stated_at_once_in_groups_that_there_were_not(tmp_path: Path) -> None:
    stated = {
        "customer.name": "Müller: Söhne #1",
        "customer.address": "Werkstraße 2",
        "certificate.issued": "2026-11-20",
        "uncertainty.negligible.device_temperature": "no length of its own",
        "uncertainty.misalignment": 0.5,
    }
    edit = edited(tmp_path, "axis: {name: X}\n", stated)
    assert edit.content.decode() == (
        HEAD.replace("kind: report}", "kind: report, issued: 2026-11-20}")
        + "axis: {name: X}\n"
        + TAIL
        + 'customer: {name: "Müller: Söhne #1", address: Werkstraße 2}\n'
        + "uncertainty: {negligible: {device_temperature: no length of its own}, misalignment: 0.5}\n"
    )
    assert edit.job.keys.customer is not None
    assert edit.job.keys.customer.name == "Müller: Söhne #1"


def test_what_a_base_file_states_in_part_is_completed_here(tmp_path: Path) -> None:
    (tmp_path / "base.yaml").write_text("axis: {name: X}\n", encoding="utf-8")
    edit = edited(tmp_path, "extends: base.yaml\n")
    assert edit.content.endswith(b"axis: {screw_pitch: 10}\n")
    assert edit.job.axis.name == "X"
    assert edit.job.axis.screw_pitch == pytest.approx(0.01)


def test_what_is_stated_already_is_left_to_whoever_wrote_it(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"write by hand: axis: \{screw_pitch: 10\}"):
        edited(tmp_path, "axis:\n  name: X\n  screw_pitch: 5\n")


def test_a_value_that_makes_no_sense_is_refused_in_the_words_of_the_job(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"uncertainty\.misalignment"):
        edited(tmp_path, "axis: {name: X}\n", {"uncertainty.misalignment": -1.0})
    assert (tmp_path / "job.yaml").read_text(encoding="utf-8") == HEAD + "axis: {name: X}\n" + TAIL
