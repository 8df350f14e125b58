"""A capture on the page: the same journal as at a terminal, begun, interrupted, gone on with, asked."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from cli.test_capture import JOB, PLUGIN, WHOLE
from environments import ROOT
from processes import PATIENCE
from web.browsers import enter
from zlmreport.plugin import Language
from zlmreport.plugin.instrument import read_journal
from zlmreport.plugin.registry import find_plugins
from zlmreport.web.app import Workbench
from zlmreport.web.capture_page import CapturePage


class Desk:
    """A browser before the page of a job whose readings an instrument tells as a story."""

    def __init__(self, browser: TestClient) -> None:
        self._browser = browser

    def get(self, **asked: str) -> dict[str, Any]:
        answer: dict[str, Any] = self._browser.get("/api/capture", params=asked).json()
        return answer

    def do(self, step: str, text: str = "") -> Any:
        return self._browser.post("/api/capture", json={"step": step, "text": text})

    def until(self, **wanted: bool) -> dict[str, Any]:
        """Return the first answer in which something is so."""
        ends = time.monotonic() + PATIENCE
        while any((found := self.get())[key] is not value for key, value in wanted.items()):
            assert time.monotonic() < ends, found
            time.sleep(0.05)
        return found

    def job(self) -> int:
        return self._browser.get("/api/job").status_code


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Iterator[Desk]:
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join((str(ROOT / "tests"), os.environ.get("PYTHONPATH", ""))))
    path = tmp_path / "job.yaml"
    path.write_text(JOB.replace("MOVES", getattr(request, "param", WHOLE)), encoding="utf-8")
    workbench = Workbench.of([path], find_plugins(files=[PLUGIN]), [PLUGIN])
    yield Desk(enter(workbench))
    workbench.end()


def test_before_it_begins_the_page_says_what_to_do(desk: Desk) -> None:
    found = desk.get()
    assert [found[key] for key in ("isCaptured", "isOver", "runs", "hasBegun")] == [True, False, False, False]
    assert found["steps"] == [
        "Let the axis stand still at −5.000 mm, for the datum.",
        "Start the program at visit 1: 0.000 mm from below, run 1.",
    ]
    assert [each["state"] for each in found["visits"]] == ["next", "open", "open", "open"]


def test_a_plan_that_changes_in_a_shared_file_is_that_of_the_page(desk: Desk, tmp_path: Path) -> None:
    job = tmp_path / "job.yaml"
    shared = job.rename(tmp_path / "shared.yaml")
    job.write_text("extends: shared.yaml\n", encoding="utf-8")
    assert [each["target"] for each in desk.get()["visits"]][1] == "20.000 mm"
    text = shared.read_text(encoding="utf-8")
    assert "[0, 20]" in text
    shared.write_text(text.replace("[0, 20]", "[0, 25]"), encoding="utf-8")
    assert [each["target"] for each in desk.get()["visits"]][1] == "25.000 mm"


def test_numbers_and_steps_are_in_the_language_of_the_page(desk: Desk) -> None:
    found = desk.get(lang="de")
    assert found["steps"][0] == "Die Achse bei −5,000 mm stillstehen lassen, für den Bezug."
    assert found["visits"][1]["target"] == "20,000 mm"


def test_all_visits_are_taken_into_the_journal_and_the_job_can_be_read(desk: Desk, tmp_path: Path) -> None:
    assert desk.job() == 422
    assert desk.do("begin").json()["runs"] is True
    found = desk.until(isOver=True)
    assert [each["state"] for each in found["visits"]] == ["taken"] * 4
    assert found["visits"][1]["deviation"] == "+3.00 µm"
    assert (found["problems"], found["steps"]) == ([], [])
    told = desk.get(lang="de")["lines"]
    assert told[0] == {"name": "Bezug", "text": "der Messwert gilt als −5,000 mm"}
    assert "Durchlauf 1 ↑" in told[1]["text"]
    history = read_journal(tmp_path / "x.journal")
    assert history is not None
    assert history.progress.is_over
    assert desk.job() == 200


@pytest.mark.parametrize("desk", ["0 lost wait 0 20 t25 20 0 -5"], indirect=True)
def test_what_the_operator_sees_to_is_asked_and_then_it_goes_on(desk: Desk) -> None:
    desk.do("begin")
    ends = time.monotonic() + PATIENCE
    while (asked := desk.get()["asked"]) is None:
        assert time.monotonic() < ends
        time.sleep(0.05)
    assert "The beam is broken" in asked["message"]
    assert asked["choices"] == []
    asked = desk.get(lang="de")["asked"]
    assert asked["message"].endswith("Was vorher genommen wurde, bleibt.")
    begin = "Das Programm bei Messpunkt 1 beginnen: 0,000 mm von unten, Durchlauf 1, Versuch 2."
    assert asked["steps"][1] == begin
    desk.do("order", "")
    assert [each["state"] for each in desk.until(isOver=True)["visits"]] == ["taken"] * 4


@pytest.mark.parametrize("desk", ["0 20"], indirect=True)
def test_an_instrument_that_goes_is_told_and_the_readings_stay(desk: Desk) -> None:
    desk.do("begin")
    found = desk.until(runs=False)
    assert "the instrument is gone" in " ".join(found["problems"])
    assert [each["state"] for each in found["visits"]] == ["taken", "taken", "next", "open"]
    assert found["hasBegun"] is True


@pytest.mark.long
@pytest.mark.parametrize("desk", ["0 20"], indirect=True)
def test_a_capture_is_closed_as_it_is(desk: Desk) -> None:
    desk.do("begin")
    desk.until(runs=False)
    desk.do("close")
    first, *_ = desk.until(isOver=True)["visits"]
    assert first["state"] == "taken"


class _Shown:
    """A capture under way, of which the present moment alone is of interest."""

    def __init__(self, **now: Any) -> None:
        self._state = {"runs": True, "now": now, "asked": None, "events": [], "problems": []}

    def describe_state(self) -> dict[str, Any]:
        return self._state


@pytest.mark.parametrize(
    ("message", "expected"), [("", ["15.000 mm", "0.20 µm", 0.5]), ("the beam is broken", [None, None, 0.0])]
)
def test_beside_a_fault_no_way_to_go_and_no_standstill_is_shown(
    message: str, expected: list[object], tmp_path: Path
) -> None:
    path = tmp_path / "job.yaml"
    path.write_text(JOB.replace("MOVES", WHOLE), encoding="utf-8")
    shown = _Shown(position=-0.015, still=0.5, range=2e-7, message=message)
    page = CapturePage(path, find_plugins(files=[PLUGIN]), shown)  # type: ignore[arg-type]
    moment = page.list_values(Language.ENGLISH)["moment"]
    assert [moment[key] for key in ("toGo", "range", "still")] == expected


def test_an_order_without_a_capture_is_refused(desk: Desk) -> None:
    answer = desk.do("order", "s")
    assert (answer.status_code, answer.json()["problems"]) == (422, ["workbench: no capture is under way"])


@pytest.mark.parametrize("text", ["r 1\ns", "x" * 301])
def test_an_order_is_one_short_line(desk: Desk, text: str) -> None:
    assert desk.do("order", text).status_code == 400


@pytest.mark.usefixtures("job")
def test_a_job_without_an_instrument_is_not_captured(browser: TestClient) -> None:
    assert browser.get("/api/capture").json() == {"isCaptured": False}
    assert browser.post("/api/capture", json={"step": "begin"}).status_code == 422
