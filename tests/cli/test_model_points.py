"""``zlmreport model fit --at``: the deviation at any position of the travel."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from model.halaj import PRINTED
from zlmreport.cli import main

_JOB = """\
schema: zlmreport/job/1
certificate: {number: POINTS-1, kind: report}
axis: {name: X, travel: [0, 500]}
measurement: {source: {plugin: laser-csv, file: readings.csv}}
instrument: {name: Laser interferometer, expanded_uncertainty: 0.4}
evaluate: [iso230-2:2014]
model: {effects: [offset, scale-error, backlash]}
output: {formats: [json]}
"""
TARGETS = range(0, 501, 50)


def truth(position: float, sign: str) -> float:
    """Return the deviation of the axis, µm."""
    return 2.0 + 0.02 * position + (-1.5 if sign == "+" else 1.5)


@pytest.fixture
def job(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a job with its readings."""
    monkeypatch.chdir(tmp_path)
    random = np.random.default_rng(3)
    rows = [
        f"{target},{sign},{run},{truth(target, sign) + 0.3 * random.standard_normal():.3f}"
        for run in (1, 2, 3)
        for sign in "+-"
        for target in (TARGETS if sign == "+" else reversed(TARGETS))
    ]
    (tmp_path / "readings.csv").write_text("\n".join(["target,direction,run,deviation", *rows]) + "\n")
    path = tmp_path / "job.yaml"
    path.write_text(_JOB, encoding="utf-8")
    return path


def _points(*options: str, capture: pytest.CaptureFixture[str]) -> list[dict[str, Any]]:
    assert main(["model", "fit", "job.yaml", "--json", *options]) == 0
    found: list[dict[str, Any]] = json.loads(capture.readouterr().out)["points"]
    return found


@pytest.mark.usefixtures("job")
def test_each_direction_has_its_deviation_between_the_targets(capsys: pytest.CaptureFixture[str]) -> None:
    points = _points("--at", "225", "--at", "10", capture=capsys)
    assert [(point["position"], point["direction"]) for point in points] == [
        (225.0, "+"),
        (225.0, "-"),
        (10.0, "+"),
        (10.0, "-"),
    ]
    for point in points:
        assert abs(point["deviation"] - truth(point["position"], point["direction"])) < 0.3
        assert 0.4 < point["expanded_uncertainty"] < 0.7  # the instrument's 0.4 µm, and the readings'


@pytest.mark.usefixtures("job")
def test_people_read_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "fit", "job.yaml", "--at", "225"]) == 0
    printed = capsys.readouterr().out
    assert re.search(r"^ +X mm +↑ µm +↓ µm$", printed, re.MULTILINE)
    assert re.search(r"^ +225 +[45]\.\d+ ± 0\.\d+ +[78]\.\d+ ± 0\.\d+$", printed, re.MULTILINE)
    assert "mean time" not in printed


def test_a_model_that_moves_says_when(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    job.write_text(_JOB.replace("backlash]", "backlash, first-run]"), encoding="utf-8")
    assert main(["model", "fit", "job.yaml", "--at", "225"]) == 0
    assert "at the mean time and the mean logged conditions" in capsys.readouterr().out


@pytest.mark.usefixtures("job")
def test_without_positions_nothing_is_said_of_any(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "fit", "job.yaml", "--json"]) == 0
    assert "points" not in json.loads(capsys.readouterr().out)


@pytest.mark.usefixtures("job")
@pytest.mark.parametrize("end", ["0", "500"])
def test_the_ends_of_the_travel_are_within(end: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert len(_points("--at", end, capture=capsys)) == 2


@pytest.mark.usefixtures("job")
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("fit", "--at=-1", "--at=501"), "--at: X = -1 mm lies outside of what was measured, 0 to 500 mm"),
        (("fit", "--at=far"), "'far' is no position; write a number, such as 250"),
        (("fit", "--at=inf"), "'inf' is no position"),
        (("history", "--at=3"), "--at belongs to fit, not to history"),
    ],
)
def test_positions_that_make_no_sense_are_refused(
    arguments: tuple[str, ...], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    action, *options = arguments
    assert main(["model", action, "job.yaml", *options]) == 2
    assert message in capsys.readouterr().err


def test_a_cubic_is_printed_for_each_direction_as_halaj_prints_it(
    job: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Equations (11) and (12), from readings that scatter evenly about them."""
    text = job.read_text(encoding="utf-8").replace("[0, 500]", "[0, 1000]")
    text = text.replace("offset, scale-error, backlash", "{polynomial: {order: 3}}")
    job.write_text(text, encoding="utf-8")
    scatter = 3e-4 * np.random.default_rng(8).standard_normal((10, 10))
    scatter -= scatter.mean(axis=0)  # of every target: what is left are the equations
    rows = [
        f"{at},{sign},{run + 1},{1000 * np.polyval(PRINTED[sign][::-1], at) + scatter[run, place]:.9f}"
        for run in range(10)
        for sign in "+-"
        for place, at in enumerate(np.linspace(0, 1000, 10).round(3))
    ]
    (job.parent / "readings.csv").write_text("\n".join(["target,direction,run,deviation", *rows]) + "\n")
    assert main(["model", "fit", "job.yaml"]) == 0
    printed = capsys.readouterr().out
    assert "Δ↑ = 0.0081716 + 2.49e−5·X − 4.7664e−8·X² + 4.6966e−11·X³\n" in printed
    assert "Δ↓ = 0.0072729 + 2.17e−5·X − 4.2836e−8·X² + 4.5325e−11·X³\n" in printed
    assert "Δ and X in mm, X from 0 to 1000" in printed

    assert main(["model", "fit", "job.yaml", "--json"]) == 0
    found = {each["direction"]: each for each in json.loads(capsys.readouterr().out)["polynomials"]}
    for sign, expected in PRINTED.items():
        assert found[sign]["coefficients"] == pytest.approx(expected, rel=1e-5)
        assert found[sign]["unit"] == "mm"
        assert np.linalg.eigvalsh(found[sign]["covariance"]).min() > -1e-12


def test_scatter_that_grows_is_said_to_be_weighted(job: Path, capsys: pytest.CaptureFixture[str]) -> None:
    random = np.random.default_rng(5)
    rows = [
        f"{at},{sign},{run},{truth(at, sign) + (0.3 + 0.0034 * at) * random.standard_normal():.4f}"
        for run in range(1, 6)
        for sign in "+-"
        for at in TARGETS
    ]
    (job.parent / "readings.csv").write_text("\n".join(["target,direction,run,deviation", *rows]) + "\n")
    assert main(["model", "fit", "job.yaml"]) == 0
    assert "Readings are weighted, for they scatter unequally: a single one by 0." in capsys.readouterr().out
    assert main(["model", "fit", "job.yaml", "--json"]) == 0
    noise = json.loads(capsys.readouterr().out)["noise"]
    assert noise["least_repeatability"] < 0.6
    assert noise["largest_repeatability"] > 1.5
