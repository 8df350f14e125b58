"""The page of a machine: its tests, what is missing, a click that makes the error fall, and the way back."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from environments import ROOT
from installed import registry
from processes import awaited
from replacing import replace_in
from web.browsers import enter, pass_by
from zlmreport.plugin import InputError, Language
from zlmreport.web.folder import JobRow, JobState, is_machine, look_at
from zlmreport.web.machine_app import MachineWorkbench

PLACE = "machine.yaml"


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """Return the example of a machine, in a folder of its own."""
    shutil.copy(ROOT / "configs" / "laboratory.yaml", tmp_path)
    return shutil.copytree(ROOT / "configs" / "machine", tmp_path / "machine") / PLACE


@pytest.fixture
def page(machine: Path) -> Iterator[TestClient]:
    made = MachineWorkbench.of(machine, registry())
    yield enter(made)
    made.end()


@pytest.fixture(scope="module")
def reader() -> Iterator[TestClient]:
    """Return a browser before the example itself, in which nobody clicks."""
    made = MachineWorkbench.of(ROOT / "configs" / "machine" / PLACE, registry())
    yield enter(made)
    made.end()


def diagnosis(page: TestClient, language: str = "en") -> dict[str, Any]:
    """Return the diagnosis that a page shows, once it is made."""
    found: dict[str, Any] = awaited(
        lambda: page.get("/api/diagnosis", params={"lang": language}).json().get("diagnosis")
    )
    return found


def clicked(page: TestClient, action: str, effect: str = "", digest: str = "") -> Any:
    """Do what a click does."""
    digest = digest or page.get("/api/job").json()["digest"]
    return page.post("/api/change", json={"based_on": digest, "action": action, "effect": effect})


def test_where_the_bar_stands_and_how_long_it_is_cannot_be_removed(page: TestClient) -> None:
    effects = page.get("/api/job").json()["effects"]
    assert {each["effect"]: each["stays"] for each in effects} == {"centre-offset": True, "radius": True}
    assert "belongs into every model" in clicked(page, "remove", "radius").text


@pytest.mark.long
def test_a_click_adds_the_effect_and_the_error_falls_and_a_step_back_restores_the_file(
    machine: Path, page: TestClient
) -> None:
    before = machine.read_text("utf-8")
    added = clicked(page, "add", "servo-mismatch").json()
    assert "[centre-offset, radius, servo-mismatch] # where" in machine.read_text("utf-8")
    assert added["undo"] == "servo-mismatch added"
    rows = page.get("/api/results").json()["fall"]["rows"]
    assert [each["name"] for each in rows[2:]] == ["servo-mismatch"]
    fallen = [float(each["cells"][0]) for each in rows]
    assert fallen == sorted(fallen, reverse=True)
    assert fallen[-1] < 0.1 * fallen[-2]
    taken_back = clicked(page, "undo").json()
    assert machine.read_text("utf-8") == before
    assert (taken_back["undo"], taken_back["redo"]) == (None, "servo-mismatch added")


def test_a_test_is_drawn_with_prediction_band_and_residual(reader: TestClient) -> None:
    (test,) = reader.get("/api/job").json()["tests"]
    assert [each["title"] for each in test["axes"]] == ["Angle", "X", "Y", "Turn", "Sense"]
    assert len(test["readings"]["deviation"]) == len(test["readings"]["residual"]) == 720
    assert [each["direction"] for each in test["model"]] == [1, -1]
    assert all(
        low < high for low, high in zip(test["model"][0]["low"], test["model"][0]["high"], strict=True)
    )


def test_a_format_that_states_what_a_job_measured_is_not_offered(page: TestClient) -> None:
    offered = {each["format"] for each in page.get("/api/job").json()["offered"]["formats"]}
    assert {"pdf", "pdf-typst", "html"} <= offered
    assert "dcc" not in offered
    asked = page.post("/api/made/certificate", json={"formats": ["dcc"]})
    assert asked.status_code == 422
    assert "no format" in asked.text


def test_where_it_differs_points_at_the_readings_there(reader: TestClient) -> None:
    found = reader.get("/api/job").json()
    first, readings = found["failures"][0], found["tests"][0]["readings"]
    assert first["statement"].startswith("counter-clockwise from ")
    senses = {readings["direction"][readings["place"].index(each)] for each in first["readings"]}
    assert senses == {1}


def test_the_numbers_say_what_of_the_axes_makes_what(reader: TestClient) -> None:
    found = reader.get("/api/results").json()
    kinds = [each["kind"] for each in found["tests"]["circle-xy"]]
    assert (kinds[0], kinds[-1], "notice" in kinds) == ("table", "graph", False)
    said = [each["text"] for each in found["tests"]["circle-xy"] if each["kind"] == "paragraph"]
    assert said[0].startswith("Of the prediction, root mean square: EYY ")
    assert [each["key"] for each in found["sections"]] == ["work-space", "cross-tables", "errors"]


def test_a_step_is_seen_before_it_is_taken(reader: TestClient) -> None:
    found = reader.get("/api/step", params={"of": "servo-mismatch", "test": "circle-xy"}).json()
    before, after = (max(map(abs, found[name]["residual"])) for name in ("before", "after"))
    assert after < 0.3 * before


@pytest.mark.long
def test_the_diagnosis_says_first_what_to_do_next(reader: TestClient) -> None:
    english, german = (diagnosis(reader, each) for each in ("en", "de"))
    assert english["next"].startswith("Next: add Servo mismatch. The error falls from 4.7 µm to 0.32 µm;")
    assert german["next"].startswith("Als Nächstes: Unterschied der Schleppabstände hinzufügen.")
    assert [each["effect"] for each in english["stairs"]] == ["servo-mismatch"]
    assert [each["key"] for each in english["sections"]] == ["absence", "plan"]
    assert german["candidates"][0]["name"] == "Unterschied der Schleppabstände"


def test_with_one_sense_nothing_is_named_and_the_next_run_comes_first(
    machine: Path, page: TestClient
) -> None:
    readings = machine.with_name("circle-xy.csv")
    lines = readings.read_text("utf-8").splitlines(keepends=True)
    readings.write_text("".join(each for each in lines if not each.startswith("cw")), "utf-8")
    found = diagnosis(page)
    assert found["next"].startswith("Next: run the same circle ")
    assert found["stairs"] == []
    assert found["noise"] is None
    assert [each["key"] for each in found["sections"]] == ["plan"]  # what is there hides what might be absent


def test_a_click_on_a_file_that_changed_meanwhile_overwrites_nothing(machine: Path, page: TestClient) -> None:
    digest = page.get("/api/job").json()["digest"]
    machine.write_text(machine.read_text("utf-8") + "# mine\n", "utf-8")
    assert clicked(page, "add", "servo-mismatch", digest).status_code == 409
    assert machine.read_text("utf-8").endswith("# mine\n")


@pytest.mark.parametrize(
    ("action", "effect", "said"),
    [
        ("add", "servo-mismach", "did you mean 'servo-mismatch'?"),
        ("add", "radius", "radius stands in the model already"),
        ("remove", "squareness", "does not stand in the model"),
        ("fix", "radius", "a machine has no action 'fix'"),
    ],
)
def test_what_makes_no_sense_is_refused_in_words(
    page: TestClient, action: str, effect: str, said: str
) -> None:
    answered = clicked(page, action, effect)
    assert answered.status_code == 422
    assert said in answered.json()["problems"][0]


def test_nobody_opens_a_machine_without_the_token(machine: Path) -> None:
    assert pass_by(MachineWorkbench.on(machine, registry())).get("/api/job").status_code == 403


def test_a_line_in_another_place_is_drawn_over_its_place(machine: Path, page: TestClient) -> None:
    line = (machine.parent / "x-positioning.yaml").read_text("utf-8").replace("EXAMPLE-2026-0021", "LINE")
    (machine.parent / "x-elsewhere.yaml").write_text(line, "utf-8")
    text = machine.read_text("utf-8").replace("[circle-xy.yaml]", "[circle-xy.yaml, x-elsewhere.yaml]")
    machine.write_text(text, "utf-8")
    _, drawn = page.get("/api/job?lang=de").json()["tests"]
    assert (drawn["kind"], drawn["arrows"]) == ("line", ["↓", "↑"])
    assert [each["title"] for each in drawn["axes"]] == ["Ort auf der Linie", "X", "Richtung"]


def test_a_folder_lists_a_machine_and_says_what_is_wrong_with_one(machine: Path) -> None:
    assert is_machine(machine)
    assert not is_machine(machine.with_name("circle-xy.yaml"))
    row, files = look_at(JobRow("key", PLACE), machine, registry())
    assert (row.state, row.axis.in_language(Language.ENGLISH), row.closed) == (
        JobState.FINE,
        "Machine, axes XYFZ",
        "",
    )
    assert machine.with_name("circle-xy.csv") in files
    replace_in(machine, ("XYFZ ", "XYZ "))
    row, _ = look_at(row, machine, registry())
    assert row.state is JobState.FAILS
    assert "'XYZ' is no chain" in row.problems[0]


def test_a_machine_that_cannot_be_read_is_refused_before_its_page_opens(machine: Path) -> None:
    replace_in(machine, ("XYFZ ", "XYZ "))
    with pytest.raises(InputError, match="is no chain"):
        MachineWorkbench.of(machine, registry())


def asked_for_tables(page: TestClient, action: str, **wanted: Any) -> Any:
    """Ask for tables across axes of Siemens' CEC, as the page does."""
    return page.post("/api/tables", json={"action": action, "controller": "siemens-840d-cec", **wanted})


def test_tables_are_written_beside_the_machine_once_their_sign_is_known_and_their_forecast_seen(
    machine: Path, page: TestClient
) -> None:
    offered = page.get("/api/job").json()["offered"]["tables"]
    assert {each["controller"]: each["isSignKnown"] for each in offered["controllers"]} == {
        "linuxcnc": True,
        "siemens-840d-cec": False,
    }
    refused = asked_for_tables(page, "write")
    assert (refused.status_code, list(machine.parent.glob("*.INI"))) == (422, [])
    assert "a wrong sign doubles the error" in refused.json()["problems"][0]
    trial = asked_for_tables(page, "trial").json()
    assert trial["files"] == ["machine-trial-across_CEC.INI"]
    assert "moves minus" in trial["sections"][0]["blocks"][0]["text"]
    seen = asked_for_tables(page, "forecast", moves="minus").json()
    assert [each["key"] for each in seen["sections"]] == ["cross-tables", "sign", "forecast"]
    assert seen["files"] == []
    assert not machine.with_name("machine-across_CEC.INI").exists()
    written = asked_for_tables(page, "write", moves="minus").json()
    assert (written["sections"], written["files"]) == (seen["sections"], ["machine-across_CEC.INI"])
    assert page.get("/documents/machine-across_CEC.INI").content == (
        machine.with_name("machine-across_CEC.INI").read_bytes()
    )
    assert asked_for_tables(page, "write", moves="minus").status_code == 422  # nothing is written over


def test_a_circle_run_again_is_held_against_the_tables(reader: TestClient) -> None:
    found = asked_for_tables(reader, "confirm", moves="minus", circles=["circle-xy.yaml"]).json()
    assert [each["key"] for each in found["sections"]] == ["confirmation"]
    said = found["sections"][0]["blocks"][0]["text"]
    assert said.startswith("Not in effect: the circles show 0.000 ± 0.010 of the tables.")
    other = asked_for_tables(reader, "confirm", moves="minus", circles=["../circle-xy.yaml"])
    assert "there is no job '../circle-xy.yaml'" in other.json()["problems"][0]
    assert asked_for_tables(reader, "confirm", moves="sideways").status_code == 400
