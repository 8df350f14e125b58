"""What a page can have made: nothing but what it offers, with the words of the command itself."""

from __future__ import annotations

import json
import shutil
import tempfile
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from installed import registry
from processes import awaited
from zlmreport.job.loading import load
from zlmreport.web.app import Workbench
from zlmreport.web.making import make_documents

_DEMANDED = "which table was active during this test"


def made(browser: TestClient, name: str, **wanted: Any) -> dict[str, Any]:
    answer = browser.post(f"/api/made/{name}", json=wanted)
    assert answer.status_code == 200, answer.text

    def found() -> dict[str, Any] | None:
        state: dict[str, Any] = browser.get(f"/api/made/{name}").json()
        return None if state["state"] == "making" else state

    state = awaited(found)
    assert state
    return state


_TABLE = "axis.compensation_table"


@pytest.fixture
def without_table(job: Path, browser: TestClient) -> Path:
    """Return the job after the page has written into it that no table was active."""
    before = browser.get("/api/job").json()
    assert not before["offered"]["tableIsStated"]
    wanted = {"based_on": before["digest"], "action": "state", "stated": {_TABLE: "none"}}
    after = browser.post("/api/change", json=wanted).json()
    assert after["offered"]["tableIsStated"]
    assert "screw_pitch: 10, compensation_table: none}" in job.read_text(encoding="utf-8")
    return job


@pytest.mark.long
def test_documents_are_made_in_the_chosen_formats_and_shown_page_by_page(browser: TestClient) -> None:
    state = made(browser, "certificate", formats=["pdf", "csv"])
    name = "EXAMPLE-2026-0007.pdf"
    assert state["files"] == ["EXAMPLE-2026-0007.csv", name]
    assert list(state["pages"]) == ["sheet", name]
    assert state["pages"]["sheet"] == 1
    pages = state["pages"][name]
    assert browser.get(f"/documents/{name}").content.startswith(b"%PDF")
    for shown in ("sheet/1", f"{name}/1", f"{name}/{pages}"):
        assert browser.get(f"/documents/{shown}.png").content.startswith(b"\x89PNG")
    for wrong in (
        "sheet/2.png",
        f"{name}/0.png",
        f"{name}/{pages + 1}.png",
        "other.pdf/1.png",
        "EXAMPLE-2026-0007.csv/1.png",
    ):
        assert browser.get(f"/documents/{wrong}").status_code == 404


@pytest.mark.long
def test_a_sheet_that_is_looked_at_lies_in_a_folder_of_its_own_until_the_workbench_ends(
    browser: TestClient, workbench: Workbench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (temporary := tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    for _ in range(2):
        made(browser, "certificate", formats=["pdf-typst"])
        (folder,) = temporary.iterdir()
        assert list(folder.glob("*.pdf"))
    workbench.end()
    assert not list(temporary.iterdir())


def test_a_table_is_refused_in_the_words_of_the_command_until_the_job_says_what_was_active(
    browser: TestClient,
) -> None:
    state = made(browser, "table", controller="csv")
    assert state["state"] == "failed"
    assert _DEMANDED in state["problems"][0]


@pytest.mark.long
def test_a_table_is_written_and_a_second_test_held_against_it(
    without_table: Path, browser: TestClient
) -> None:
    state = made(browser, "table", controller="csv", step=30)
    assert state["files"][0] == "EXAMPLE-2026-0007-compensation.csv"
    forecast = state["values"]["forecast"]
    assert forecast["after"]["E"] < forecast["before"]["E"]
    shutil.copy(without_table, without_table.with_name("after.yaml"))
    assert browser.get("/api/job").json()["offered"]["jobs"] == ["after.yaml"]
    found = made(browser, "confirmation", controller="csv", after="after.yaml")
    assert found["values"]["acts"] == "not-in-effect"  # the same readings: no table acts in them


def test_a_mistake_is_told_as_a_terminal_has_it_with_a_line_or_without() -> None:
    place = {"file": "job.yaml", "line": 3, "column": 7}
    problems = [
        {**place, "message": "is wrong"},
        {"file": "out", "line": None, "column": None, "message": "cannot be written"},
    ]
    found = make_documents(json.dumps({"jobs": [{"files": [], "problems": problems}]}), "")
    assert found.problems == ("job.yaml:3:7: is wrong", "out: cannot be written")


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("certificate", {"formats": ["--output"]}),
        ("table", {"controller": "--plugin"}),
        ("table", {}),
        ("confirmation", {"controller": "csv", "after": "../job.yaml"}),
        ("confirmation", {"controller": "csv", "after": "job.yaml"}),
    ],
)
def test_nothing_is_made_that_the_page_does_not_offer(
    browser: TestClient, name: str, wanted: dict[str, Any]
) -> None:
    answer = browser.post(f"/api/made/{name}", json=wanted)
    assert answer.status_code == 422
    assert "there is no" in answer.json()["problems"][0]


@pytest.mark.parametrize("wanted", [{"step": -1}, {"step": "x"}, {"path": "/etc"}, []])
def test_what_no_page_sends_begins_nothing(browser: TestClient, wanted: Any) -> None:
    assert browser.post("/api/made/table", json=wanted).status_code == 400
    assert browser.get("/api/made/table").json() == {"state": "none"}


def test_there_is_nothing_else_to_make(browser: TestClient) -> None:
    assert browser.get("/api/made/fleet").status_code == 404
    assert browser.post("/api/made/fleet", json={}).status_code == 404


@pytest.fixture
def tied(job: Path) -> Path:
    """Return the job where the axis was always at 25 °C: its scale is too long, or has grown."""
    readings = job.with_name("x-axis.csv")
    lines = [
        line.split(",")[:6] for line in readings.read_text(encoding="utf-8").splitlines() if line[0] != "#"
    ]
    table = [cells if cells[0] == "target" else [*cells[:5], "25.00"] for cells in lines]
    readings.write_text("\n".join(map(",".join, table)), encoding="utf-8")
    text = job.read_text(encoding="utf-8").replace("    - scale-error\n", "    - screw-pitch\n")
    job.write_text(text, encoding="utf-8")
    return job


@pytest.mark.long
def test_the_experiment_that_decides_a_tie_is_told_with_the_diagnosis_and_its_job_written(
    tied: Path, browser: TestClient
) -> None:
    found = awaited(lambda: browser.get("/api/diagnosis?lang=en").json().get("diagnosis"))
    experiment = found["experiment"]
    assert experiment["effects"] == ["scale-error", "scale-expansion"]
    assert "3 K" in experiment["statement"]
    state = made(browser, "experiment", effects=experiment["effects"])
    assert state["files"] == ["EXAMPLE-2026-0007-decide.yaml"], state
    written = load(tied.with_name("EXAMPLE-2026-0007-decide.yaml"), registry())
    assert written.keys.plan is not None
    assert made(browser, "experiment", effects=experiment["effects"])["state"] == "failed"  # it is there


def test_no_experiment_is_made_of_what_is_no_effect(browser: TestClient) -> None:
    answer = browser.post("/api/made/experiment", json={"effects": ["--output", "/"]})
    assert answer.status_code == 422
