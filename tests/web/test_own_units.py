"""A quantity in a unit of its own, such as the slope of a straightness test, is shown in that unit."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from installed import registry
from web.browsers import enter
from zlmreport.web.app import Workbench

_JOB = """schema: zlmreport/job/1
certificate: {number: S-1, kind: report}
machine: {model: MT 500}
axis: {name: Y, travel: [0, 400]}
measurement: {date: 2026-01-02, error: EXY, source: {plugin: laser-csv, file: straight.csv}}
evaluate: [{standard: "iso230-1:2012", tolerances: {EXY: 2.125}}]
model: {effects: [offset]}
"""
#: µm/m.
_SLOPE = 12.0


@pytest.fixture
def straight(tmp_path: Path) -> Iterator[TestClient]:
    rows = [
        f"{target},{direction},{run},{_SLOPE * target / 1000 + 0.3 * (run - 2):.1f}"
        for run in (1, 2, 3)
        for direction in "+-"
        for target in range(0, 401, 50)[:: 1 if direction == "+" else -1]
    ]
    (tmp_path / "straight.csv").write_text("\n".join(["target,direction,run,deviation", *rows]) + "\n")
    jobs = [tmp_path / "job.yaml", tmp_path / "second.yaml"]
    for job in jobs:
        job.write_text(_JOB)
    workbench = Workbench.of(jobs, registry())
    yield enter(workbench)
    workbench.end()


def test_of_the_standards_panel(straight: TestClient) -> None:
    (standard,) = straight.get("/api/results?lang=de").json()["standards"]
    slope = standard["rows"][-1]
    assert standard["unit"] == "µm"
    assert (slope["value"], slope["limit"]) == ("12,00 µm/m", "–")
    assert [each["limit"] for each in standard["rows"]][:2] == ["2,125", "–"]  # as the job states it
    assert not any(each["value"].endswith("m") for each in standard["rows"][:-1])


def test_no_control_corrects_a_straightness_and_no_page_says_what_would_be_left(straight: TestClient) -> None:
    (standard,) = straight.get("/api/results?lang=en").json()["standards"]
    assert {each["by_table"] for each in standard["rows"]} == {each["by_model"] for each in standard["rows"]}
    assert {each["by_model"] for each in standard["rows"]} == {None}
    assert straight.get("/api/job").json()["offered"]["takesTable"] is False


def test_of_compared_tests(straight: TestClient) -> None:
    (standard,) = straight.get("/api/tests?lang=en").json()["standards"]
    for cell in standard["rows"][-1]["cells"]:
        assert (cell["value"], cell["unit"]) == ("12.00", "µm/m")
        assert cell["number"] == pytest.approx(_SLOPE)
    assert {cell["unit"] for row in standard["rows"][:-1] for cell in row["cells"]} == {""}
