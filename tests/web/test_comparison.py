"""Several tests of one axis on one page: what is laid over the readings, and what is told of each."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from installed import registry
from web.browsers import enter
from web.jobs import EXAMPLE
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.plugin import InputError
from zlmreport.web.app import Workbench

#: What the other test reads more at a target upwards and downwards, in µm.
_MORE = {"+": 2.5, "-": -1.5}
_ROTARY = EXAMPLE.parent / "rotary-axis" / "report.yaml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a test of an axis, and one of half a year before that read otherwise."""
    folder = tmp_path_factory.mktemp("tests")
    text = (EXAMPLE / "job.yaml").read_text(encoding="utf-8")
    own = text.replace("2026-11-18", "2026-11-02")
    (folder / "after.yaml").write_text(own, encoding="utf-8")
    before = text.replace("2026-11-18", "2026-05-04")
    (folder / "before.yaml").write_text(before.replace("x-axis.csv", "before.csv"), encoding="utf-8")
    shutil.copy(EXAMPLE / "x-axis.csv", folder)
    (folder / "before.csv").write_text(_shifted(folder / "x-axis.csv"), encoding="utf-8")
    return folder


def _shifted(path: Path) -> str:
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        cells = line.split(",")
        if cells[0][:1].isdigit():
            cells[3] = f"{float(cells[3]) + _MORE[cells[1]]:.2f}"
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def _compared(*paths: Path) -> dict[str, Any]:
    workbench = Workbench.of(paths, registry())
    found: dict[str, Any] = enter(workbench).get("/api/tests?lang=en").json()
    workbench.end()
    return found


@pytest.fixture(scope="module")
def found(folder: Path) -> dict[str, Any]:
    return _compared(folder / "after.yaml", folder / "before.yaml")


def test_tests_stand_in_the_order_of_their_days(found: dict[str, Any]) -> None:
    assert [(each["name"], each["day"], each["isHere"]) for each in found["tests"]] == [
        ("before", "2026-05-04", False),
        ("after", "2026-11-02", True),
    ]


def test_the_curve_of_a_test_is_its_mean_deviation(folder: Path, found: dict[str, Any]) -> None:
    readings = pipeline.read(load(folder / "before.yaml", registry()), registry())
    for curve, means in zip(
        found["tests"][0]["curves"], np.nanmean(readings.deviations(), axis=2), strict=True
    ):
        assert curve["y"] == pytest.approx(1e6 * means[np.isfinite(means)], abs=1e-5)


def test_the_difference_is_the_other_test_less_this_one(found: dict[str, Any]) -> None:
    before, here = found["tests"]
    for curve, more in zip(before["curves"], _MORE.values(), strict=True):
        assert curve["difference"] == pytest.approx([more] * len(curve["x"]), abs=1e-5)
    assert all(value == 0 for curve in here["curves"] for value in curve["difference"])


def test_between_its_targets_this_test_is_taken_as_straight_and_beyond_them_not_at_all(
    folder: Path, tmp_path: Path
) -> None:
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    for name, rows in (
        ("x-axis.csv", [(0, 0.0), (100, 10.0), (200, 40.0)]),
        ("before.csv", [(50, 1.0), (150, 1.0), (250, 1.0)]),
    ):
        taken = [f"{at},{side},{run},{value}" for run in (1, 2) for side in "+-" for at, value in rows]
        (tmp_path / name).write_text("\n".join(["target,direction,run,deviation", *taken]), encoding="utf-8")
    other = _compared(tmp_path / "after.yaml", tmp_path / "before.yaml")["tests"][0]
    for curve in other["curves"]:
        assert curve["difference"] == [pytest.approx(-4.0), pytest.approx(-24.0), None]


def test_each_parameter_has_its_amount_in_each_test(found: dict[str, Any]) -> None:
    (standard,) = found["standards"]
    rows = {"".join(span["text"] for span in row["symbol"]): row["cells"] for row in standard["rows"]}
    before, after = rows["B̄"]
    assert before["number"] - after["number"] == pytest.approx(sum(map(abs, _MORE.values())), abs=0.01)


def test_models_stand_side_by_side(found: dict[str, Any]) -> None:
    (backlash,) = (row for row in found["models"] if row["called"] == "backlash")
    before, after = (float(cell["value"].replace("−", "-")) for cell in backlash["cells"])
    assert before - after == pytest.approx(sum(map(abs, _MORE.values())), abs=0.02)


def test_the_axis_as_found_is_a_test_of_its_own(tmp_path: Path) -> None:
    shutil.copytree(EXAMPLE.parent / "as-found", tmp_path / "as-found")
    shutil.copy(EXAMPLE.parent / "laboratory.yaml", tmp_path)
    found = _compared(tmp_path / "as-found" / "certificate.yaml")
    assert [each["name"] for each in found["tests"]] == ["certificate, as found", "certificate"]
    a_before, a_after = found["standards"][0]["rows"][0]["cells"]
    assert a_before["number"] > 3 * a_after["number"]
    assert a_before["expanded"] > 0


def test_one_test_is_compared_with_nothing(folder: Path) -> None:
    assert _compared(folder / "after.yaml")["tests"] == []


def test_another_kind_of_axis_is_refused(folder: Path) -> None:
    with pytest.raises(InputError, match=r"the axis is rotary.*no tests of one axis"):
        _compared(folder / "after.yaml", _ROTARY)


def _measuring(job: Path, error: str) -> None:
    """Let a job say that it measured a straightness."""
    text = job.read_text(encoding="utf-8").replace("method: linear", f"method: linear\n  error: {error}")
    job.write_text(text.replace("iso230-2:2014", '"iso230-1:2012"'), encoding="utf-8")


@pytest.mark.parametrize(
    ("own", "ours"), [("", "positioning accuracy of"), ("EZX", "straightness error EZX of")]
)
def test_another_error_of_the_axis_is_refused(folder: Path, tmp_path: Path, own: str, ours: str) -> None:
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    after, before = tmp_path / "after.yaml", tmp_path / "before.yaml"
    _measuring(before, "EYX")
    if own:
        _measuring(after, own)
    message = rf"it measured the straightness error EYX of axis X, and .*after.yaml the {ours} axis X: these"
    with pytest.raises(InputError, match=message):
        _compared(after, before)


def test_positioning_may_have_its_symbol_in_one_test_and_none_in_the_other(
    folder: Path, tmp_path: Path
) -> None:
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    text = (tmp_path / "before.yaml").read_text(encoding="utf-8")
    named = text.replace("method: linear", "method: linear\n  error: EXX")
    (tmp_path / "before.yaml").write_text(named, encoding="utf-8")
    assert len(_compared(tmp_path / "after.yaml", tmp_path / "before.yaml")["tests"]) == 2


@pytest.fixture
def browser(folder: Path, tmp_path: Path) -> Iterator[TestClient]:
    """Return a browser before a test of an axis and an earlier one, which may be spoilt."""
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    workbench = Workbench.of([tmp_path / "after.yaml", tmp_path / "before.yaml"], registry())
    yield enter(workbench)
    workbench.end()


def test_a_test_that_cannot_be_read_is_named_and_is_there_again_when_it_can(
    browser: TestClient, tmp_path: Path
) -> None:
    readings = tmp_path / "before.csv"
    kept, stamp = readings.read_bytes(), browser.get("/api/stamp").json()["tests"]
    readings.unlink()
    assert browser.get("/api/stamp").json()["tests"] != stamp
    without = browser.get("/api/tests").json()
    assert without["tests"] == []
    assert "before.csv" in without["problems"][0]
    readings.write_bytes(kept)
    assert len(browser.get("/api/tests").json()["tests"]) == 2


def test_nothing_is_written_beside_the_other_tests(browser: TestClient, tmp_path: Path) -> None:
    def files() -> dict[Path, bytes]:
        return {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}

    before = files()
    browser.get("/api/tests")
    assert files() == before
