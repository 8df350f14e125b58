"""A length of the axis is written into a job: with its unit where there is room, and nothing else changes."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from zlmreport.errors import InputError
from zlmreport.job.edit import Edit
from zlmreport.job.edit_axis import edit_axis
from zlmreport.job.loading import load
from zlmreport.plugins import Registry, find_plugins

HEAD = "schema: zlmreport/job/1\ncertificate: {number: CAL-1, kind: report}  # a remark\n"
TAIL = "measurement: {source: {plugin: laser-csv, file: x.csv}}\nevaluate: [nmtba]\n"


@cache
def registry() -> Registry:
    return find_plugins()


def edited(folder: Path, axis: str, key: str = "screw_pitch", value: float = 10.0) -> Edit:
    path = folder / "job.yaml"
    path.write_text(HEAD + axis + TAIL, encoding="utf-8")
    return edit_axis(path, load(path, registry()), registry(), key, value)


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
    edit = edited(tmp_path, "axis:\n  name: C\n  kind: rotary\n", value=2.5)
    assert b"screw_pitch: 2.5 # \xc2\xb0\n" in edit.content


@pytest.mark.parametrize(
    "axis", ["extends: base.yaml\n", "axis:\n  name: X\n  screw_pitch: 5\n"], ids=["inherited", "stated"]
)
def test_what_cannot_be_added_is_said_with_what_to_write(tmp_path: Path, axis: str) -> None:
    (tmp_path / "base.yaml").write_text("axis: {name: X}\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"write by hand: axis: \{screw_pitch: 10\}"):
        edited(tmp_path, axis)
