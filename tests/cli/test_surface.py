"""``zlmreport surface``: from the jobs of the lines to the deviation at any point."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from replacing import replaced
from zlmreport.cli import main

TARGETS = tuple(range(0, 501, 50))
LINES = (100, 200, 300, 400)
LOST_MOTION = -3.0
#: Coefficients of X, X², Y and Y², µm and mm.
BOW = (0.02, -3e-5, 0.01, 2e-5)

_SHARED = """\
certificate: {kind: report}
machine: {serial: EXAMPLE}
axis: {name: X, travel: [0, 500]}
instrument: {name: Laser interferometer, expanded_uncertainty: 0.4}
evaluate: [iso230-2:2014]
output: {formats: [json]}
"""
_LINE = """\
schema: zlmreport/job/1
extends: shared.yaml
certificate: {number: PLANE-NUMBER}
measurement:
  source: {plugin: laser-csv, file: NUMBER.csv}
  plane: {axis: Y, at: NUMBER}
"""


def truth(x: float, y: float, sign: str) -> float:
    """Return the deviation of the plane, µm."""
    bow = BOW[0] * x + BOW[1] * x**2 + BOW[2] * y + BOW[3] * y**2
    return 1.0 + bow + (LOST_MOTION if sign == "+" else -LOST_MOTION) / 2


@dataclass(frozen=True)
class Bench:
    """A folder with the lines of a plane, and a command line in it."""

    folder: Path
    capture: pytest.CaptureFixture[str]

    def line(self, at: int, *changes: tuple[str, str], signs: str = "+-", sigma: float = 0.3) -> None:
        """Write the job and the readings of a line; `changes` replace parts of the job."""
        job = replaced(_LINE, ("NUMBER", str(at)), *changes)
        (self.folder / f"{at}.yaml").write_text(job, encoding="utf-8")
        random = np.random.default_rng(at)
        rows = [
            f"{x},{sign},{run},{truth(x, at, sign) + sigma * random.standard_normal():.4f}"
            for run in (1, 2, 3)
            for sign in signs
            for x in (TARGETS if sign == "+" else TARGETS[::-1])
        ]
        table = "\n".join(["target,direction,run,deviation", *rows])
        (self.folder / f"{at}.csv").write_text(table + "\n", encoding="utf-8")

    def run(self, *options: str, lines: Sequence[int] = LINES) -> tuple[int, str, list[str]]:
        """Return exit code, output, and messages."""
        self.capture.readouterr()
        code = main(["surface", *(f"{at}.yaml" for at in lines), *options])
        output, messages = self.capture.readouterr()
        return code, output, messages.splitlines()

    def values(self, *options: str, lines: Sequence[int] = LINES) -> dict[str, Any]:
        """Return what is printed as JSON."""
        code, output, messages = self.run("--json", *options, lines=lines)
        assert (code, messages) == (0, [])
        found: dict[str, Any] = json.loads(output)
        return found


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Bench:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "shared.yaml").write_text(_SHARED, encoding="utf-8")
    found = Bench(tmp_path, capsys)
    for at in LINES:
        found.line(at)
    return found


def test_the_deviation_at_a_point_is_stated_for_each_direction(bench: Bench) -> None:
    for direction in bench.values("--at", "225,130")["directions"]:
        (point,) = direction["points"]
        assert (point["along"], point["across"]) == (225.0, pytest.approx(130.0))
        assert (
            abs(point["deviation"] - truth(225, 130, direction["direction"]))
            < 2 * point["expanded_uncertainty"]
        )
        assert 0.4 < point["expanded_uncertainty"] < 0.6  # the instrument's 0.4 µm, and the readings'


def test_axis_that_no_cubic_describes_is_said_to_be_off_by_more_than_the_uncertainty(bench: Bench) -> None:
    assert "misses" not in bench.run()[1]
    for at in LINES:
        header, *rows = (bench.folder / f"{at}.csv").read_text(encoding="utf-8").splitlines()
        cells = [row.split(",") for row in rows]
        waved = [f"{x},{sign},{run},{float(e) + 2 * np.sin(float(x) / 40):.4f}" for x, sign, run, e in cells]
        (bench.folder / f"{at}.csv").write_text("\n".join([header, *waved]) + "\n", encoding="utf-8")
    said = " ".join(bench.run()[1].split())
    assert said.count("± below is its own uncertainty, and the axis may be off by more") == 2
    for direction in bench.values()["directions"]:
        error = direction["error"]
        assert direction["missed"] == pytest.approx(np.sqrt(error["rms"] ** 2 - error["noise_rms"] ** 2))
        assert 1.0 < direction["missed"] < 2 / np.sqrt(2)


def test_coefficients_give_the_deviation_at_every_point(bench: Bench) -> None:
    for direction in bench.values()["directions"]:
        by_name = {each["name"]: each["value"] for each in direction["coefficients"]}
        for point in direction["points"]:
            x, y = point["along"], point["across"]
            value = by_name["a"]
            for axis, place in (("1", x), ("2", y)):
                value += sum(
                    by_name[f"{letter}{axis}"] * place**power for power, letter in enumerate("bcd", 1)
                )
            assert value == pytest.approx(point["deviation"], rel=1e-9)
        assert len(direction["covariance"]) == len(by_name) == 7


def test_coefficients_have_units(bench: Bench) -> None:
    (direction, _) = bench.values()["directions"]
    units = [each["unit"] for each in direction["coefficients"]]
    assert units == ["um", "um/mm", "um/mm2", "um/mm3", "um/mm", "um/mm2", "um/mm3"]


def test_the_order_of_the_jobs_does_not_matter(bench: Bench) -> None:
    there, back = bench.values(), bench.values(lines=LINES[::-1])
    assert there["lines"] == back["lines"]
    assert there["directions"] == back["directions"]


def test_what_people_read(bench: Bench) -> None:
    code, output, _ = bench.run("--at", "225,130", "--at=0,400")
    assert code == 0
    assert "4 lines, at Y = 100, 200, 300, 400 mm" in output
    assert "Δ in µm, positions in mm" in output
    assert re.findall(r"^ +(\d+) +(\d+) +\S+ ± ", output, re.MULTILINE) == [("225", "130"), ("0", "400")]
    assert output.count("not needed") == 2
    assert "instrument kept its zero" in " ".join(output.split())


def test_without_points_a_table_covers_the_plane(bench: Bench) -> None:
    points = bench.values()["directions"][0]["points"]
    assert len(points) == 15
    assert {point["across"] for point in points} == {100.0, 250.0, 400.0}


@pytest.mark.parametrize(
    ("changes", "place", "sentence"),
    [
        ([("  plane: {axis: Y, at: 200}\n", "")], "200.yaml:4:", "does not say where its line lies"),
        ([("axis: Y", "axis: Z")], "200.yaml:6:", "the second axis is Z here and Y in the first job"),
        (
            [("measurement:", "axis: {name: W}\nmeasurement:")],
            "200.yaml:4:",
            "of axis W (linear), the first one of axis X (linear)",
        ),
        (
            [("measurement:", "axis: {kind: rotary}\nmeasurement:")],
            "shared.yaml:3:",
            "of axis X (rotary), the first one of axis X (linear)",
        ),
        (
            [
                ("measurement:", 'evaluate: ["iso230-1:2012"]\nmeasurement:'),
                ("  plane:", "  error: EYX\n  plane:"),
            ],
            "200.yaml:7:",
            "of error EYX, the first one of error EXX",
        ),
        (
            [("measurement:", "machine: {serial: OTHER}\nmeasurement:")],
            "200.yaml:4:",
            "of machine OTHER, the first one of machine EXAMPLE",
        ),
        (
            [("measurement:", "instrument: {expanded_uncertainty: 0.9}\nmeasurement:")],
            "200.yaml:4:",
            "one instrument measures a plane",
        ),
        ([("at: 200", "at: far")], "200.yaml:6:", "far"),
    ],
)
def test_jobs_that_are_no_lines_of_one_plane_are_refused(
    bench: Bench, changes: list[tuple[str, str]], place: str, sentence: str
) -> None:
    bench.line(200, *changes)
    code, output, messages = bench.run()
    assert (code, output) == (2, "")
    assert any(message.startswith(place) and sentence in message for message in messages)


def test_every_mistake_is_named_at_once(bench: Bench) -> None:
    bench.line(200, ("axis: Y", "axis: Z"))
    bench.line(300, ("axis: Y", "axis: V"), signs="+")
    _, _, messages = bench.run()
    assert [message.split(":")[0] for message in messages] == ["200.yaml", "300.yaml", "300.yaml"]
    assert "this line was approached ↑, the first one ↑ and ↓" in messages[2]


def test_mistakes_of_several_jobs_are_named_at_once(bench: Bench) -> None:
    bench.line(200, ("at: 200", "at: far"))
    bench.line(300, ("plane:", "plain:"))
    code, _, messages = bench.run()
    assert code == 2
    assert [message.split(":")[0] for message in messages] == ["200.yaml", "300.yaml"]


def test_a_job_that_is_not_there_is_said_to_be_so(bench: Bench) -> None:
    code, _, messages = bench.run(lines=(100, 900))
    assert code == 3
    assert messages[0].startswith("900.yaml")


def test_lines_at_one_place_are_no_plane(bench: Bench) -> None:
    code, _, messages = bench.run(lines=(100, 100))
    assert code == 2
    assert "two positions of the second axis" in messages[0]


def test_the_second_axis_is_another_one(bench: Bench) -> None:
    for at in LINES:
        bench.line(at, ("axis: Y", "axis: X"))
    _, _, messages = bench.run()
    assert messages == ["100.yaml:6:17: X is the axis under test; name the other axis of the plane"]


def test_a_rotary_axis_has_no_plane(bench: Bench) -> None:
    for at in LINES:
        bench.line(at, ("measurement:", "axis: {kind: rotary}\nmeasurement:"))
    code, _, messages = bench.run()
    assert code == 2
    assert "two linear axes" in messages[0]


@pytest.mark.parametrize(
    ("point", "sentence"),
    [
        ("250,900", "--at: Y = 900 mm lies outside of what was measured, 100 to 400 mm"),
        ("-1,200", "--at: X = -1 mm lies outside of what was measured, 0 to 500 mm"),
        ("250", "'250' is no point; write two positions in mm"),
        ("nan,1", "'nan,1' is no point"),
    ],
)
def test_a_point_that_makes_no_sense_is_refused(bench: Bench, point: str, sentence: str) -> None:
    code, _, messages = bench.run(f"--at={point}")
    assert code == 2
    assert sentence in messages[0]
