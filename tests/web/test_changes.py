"""What is clicked stands in the job file, and what others wrote there stays."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from installed import registry
from zlmreport.job.loading import load
from zlmreport.web.app import Workbench


@pytest.fixture
def before(browser: TestClient) -> dict[str, Any]:
    """Return the job as the page shows it."""
    found: dict[str, Any] = browser.get("/api/job").json()
    return found


def click(browser: TestClient, before: dict[str, Any], **wanted: Any) -> dict[str, Any]:
    answer = browser.post("/api/change", json={"based_on": before["digest"], **wanted})
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = answer.json()
    return found


def refused(browser: TestClient, before: dict[str, Any], **wanted: Any) -> str:
    answer = browser.post("/api/change", json={"based_on": before["digest"], **wanted})
    assert answer.status_code == 422
    return "\n".join(answer.json()["problems"])


def effects(path: Path) -> dict[str, dict[str, float]]:
    return {each.identifier: dict(each.values) for each in load(path, registry()).effects}


def test_an_effect_is_added_and_the_error_falls(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    click(browser, before, action="add", effect="screw-pitch")
    assert list(effects(job)) == ["offset", "scale-error", "backlash", "screw-pitch"]
    shares = [row["share"] for row in browser.get("/api/results").json()["fall"]["rows"]]
    assert shares == sorted(shares, reverse=True)
    assert len(shares) == 1 + 4


def test_comments_and_layout_stay(job: Path, browser: TestClient, before: dict[str, Any]) -> None:
    text = job.read_text(encoding="utf-8")
    click(browser, before, action="add", effect="screw-pitch")
    assert job.read_text(encoding="utf-8") == text.replace(
        "    - backlash\n", "    - backlash\n    - screw-pitch\n"
    )


def test_an_effect_is_removed(job: Path, browser: TestClient, before: dict[str, Any]) -> None:
    click(browser, before, action="remove", effect="backlash")
    assert list(effects(job)) == ["offset", "scale-error"]


def test_an_effect_that_explains_nothing_is_refused(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    text = job.read_text(encoding="utf-8")
    after = click(browser, before, action="add", effect="screw-pitch")
    assert "explains nothing here" in refused(browser, after, action="add", effect="backlash-bow")
    click(browser, after, action="undo")
    assert job.read_text(encoding="utf-8") == text


def test_a_parameter_is_fixed_and_freed(job: Path, browser: TestClient, before: dict[str, Any]) -> None:
    text = job.read_text(encoding="utf-8")
    after = click(browser, before, action="fix", effect="backlash", parameter="lost_motion", value=-4)
    assert effects(job)["backlash"] == {"lost_motion": -4.0}
    (found,) = (each for each in after["effects"] if each["effect"] == "backlash")
    assert found["parameters"][0] | {"given": True, "fixed": True} == found["parameters"][0]
    click(browser, after, action="free", effect="backlash", parameter="lost_motion")
    assert job.read_text(encoding="utf-8") == text


@pytest.mark.parametrize(
    "effects_of_job",
    [
        ("- backlash", "- backlash: {lost_motion: {min: -2, max: 2}}"),
        (
            "- {name: wave, formula: a*sin(2*pi*P/L), parameters: {a: {unit: um}, L: {unit: mm, value: 10}}}",
            "- {name: wave, formula: a*sin(2*pi*P/L), parameters: {a: {unit: um}, L: {unit: mm, value: 7}}}",
        ),
    ],
    ids=["a bound", "a formula"],
)
def test_what_an_editor_says_of_an_effect_is_fitted_anew_and_known_when_it_is_said_again(
    job: Path, workbench: Workbench, browser: TestClient, effects_of_job: tuple[str, str]
) -> None:
    text = job.read_text(encoding="utf-8")
    shown = []
    for each in (*effects_of_job, *effects_of_job):
        job.write_text(text.replace("- backlash", each), encoding="utf-8")
        shown.append(
            (browser.get("/api/job").json()["error"], workbench.bench.fit_whole(workbench.bench.load()))
        )
    (first, fit), (second, other), (again, fit_again), (_, other_again) = shown
    assert first == again != second
    assert fit_again is fit
    assert other_again is other is not fit


def test_a_parameter_that_there_is_not_is_refused(browser: TestClient, before: dict[str, Any]) -> None:
    assert "no parameter 'backlash.gain'" in refused(
        browser, before, action="fix", effect="backlash", parameter="gain", value=1
    )


def test_a_reading_is_set_aside_for_a_reason_and_comes_back(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    after = click(browser, before, action="exclude", readings=[12], reason="Air hose")
    (excluded,) = load(job, registry()).keys.measurement.excluded
    assert excluded.reason == "Air hose"
    assert len(after["graphs"]["readings"]["place"]) == len(before["graphs"]["readings"]["place"]) - 1
    assert 12 not in after["graphs"]["readings"]["place"]
    assert after["excluded"][0]["reason"] == "Air hose"
    back = click(browser, after, action="include", listed=0)
    assert back["excluded"] == []
    assert back["graphs"] == before["graphs"]


@pytest.mark.parametrize("reason", ["", "  ", "two\nlines"])
def test_no_reading_is_set_aside_without_a_reason(
    browser: TestClient, before: dict[str, Any], reason: str
) -> None:
    assert "for a reason" in refused(browser, before, action="exclude", readings=[12], reason=reason)


@pytest.mark.parametrize(
    "wanted",
    [
        {"action": "exclude", "readings": [210]},
        {"action": "exclude", "readings": [12, -1]},
        {"action": "exclude", "readings": []},
        {"action": "include", "listed": 0},
    ],
)
def test_a_reading_that_there_is_not_is_refused(
    browser: TestClient, before: dict[str, Any], wanted: dict[str, Any]
) -> None:
    refused(browser, before, reason="because", **wanted)


def test_readings_in_a_box_are_set_aside_together_and_undone_together(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    text = job.read_text(encoding="utf-8")
    after = click(browser, before, action="exclude", readings=[12, 13, 14], reason="Air hose")
    assert [each.reason for each in load(job, registry()).keys.measurement.excluded] == ["Air hose"] * 3
    assert after["undo"] == "reading set aside: 3 readings"
    click(browser, after, action="undo")
    assert job.read_text(encoding="utf-8") == text


#: Lines that a record of steps may come to hold, and that are passed over.
NO_STEPS = ["", "{", "[]", "1", '{"schema": "other/1"}', '{"schema": "zlmreport/workbench-history/1"}']


def test_undo_puts_back_what_was(job: Path, browser: TestClient, before: dict[str, Any]) -> None:
    text = job.read_text(encoding="utf-8")
    once = click(browser, before, action="add", effect="screw-pitch")
    with job.with_name("job.history.jsonl").open("a", encoding="utf-8") as record:
        record.writelines(f"{line}\n" for line in NO_STEPS)
    twice = click(browser, once, action="remove", effect="offset")
    assert twice["undo"] == "offset removed"
    back = click(browser, twice, action="undo")
    assert back["undo"] == "screw-pitch added"
    start = click(browser, back, action="undo")
    assert start["undo"] is None
    assert job.read_text(encoding="utf-8") == text


@pytest.mark.long
def test_what_was_undone_is_done_again_until_something_else_is_done(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    once = click(browser, before, action="add", effect="screw-pitch")
    twice = click(browser, once, action="remove", effect="offset")
    text = job.read_text(encoding="utf-8")
    assert (before["redo"], once["redo"]) == (None, None)
    back = click(browser, twice, action="undo")
    start = click(browser, back, action="undo")
    assert start["redo"] == "screw-pitch added"
    again = click(browser, start, action="redo")
    assert (again["undo"], again["redo"]) == ("screw-pitch added", "offset removed")
    whole = click(browser, again, action="redo")
    assert whole["redo"] is None
    assert job.read_text(encoding="utf-8") == text
    back = click(browser, whole, action="undo")
    assert back["redo"] == "offset removed"
    other = click(browser, back, action="remove", effect="backlash")
    assert other["redo"] is None
    assert (
        browser.post("/api/change", json={"based_on": other["digest"], "action": "redo"}).status_code == 409
    )


def test_a_step_that_cannot_be_recorded_is_said_and_not_done(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    content = job.read_bytes()
    job.with_name("job.history.jsonl").mkdir()
    assert "cannot be" in refused(browser, before, action="add", effect="screw-pitch")
    assert job.read_bytes() == content


def test_what_somebody_else_wrote_is_not_undone(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    click(browser, before, action="add", effect="screw-pitch")
    job.write_text(job.read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
    outside = browser.get("/api/job").json()
    assert outside["undo"] is None
    answer = browser.post("/api/change", json={"based_on": outside["digest"], "action": "undo"})
    assert answer.status_code == 409
    assert job.read_text(encoding="utf-8").endswith("# mine\n")


def test_a_second_window_does_not_overwrite_the_first(
    job: Path, browser: TestClient, before: dict[str, Any]
) -> None:
    click(browser, before, action="add", effect="screw-pitch")
    text = job.read_text(encoding="utf-8")
    second = browser.post(
        "/api/change", json={"based_on": before["digest"], "action": "remove", "effect": "offset"}
    )
    assert second.status_code == 409
    assert "changed elsewhere" in second.json()["problems"][0]
    assert job.read_text(encoding="utf-8") == text


def test_a_conflict_is_told_in_the_language_of_the_page(browser: TestClient) -> None:
    answer = browser.post("/api/change?lang=de", json={"based_on": "", "action": "undo"})
    assert "an anderer Stelle geändert" in answer.json()["problems"][0]


@pytest.mark.parametrize(
    "body", [{}, {"based_on": "x"}, {"based_on": "x", "action": "add", "path": "/etc/passwd"}, [], "add"]
)
def test_what_no_page_sends_is_refused(browser: TestClient, body: Any) -> None:
    assert browser.post("/api/change", json=body).status_code == 400


def test_an_action_that_there_is_not_is_refused(browser: TestClient, before: dict[str, Any]) -> None:
    assert "there is no action 'delete'" in refused(browser, before, action="delete")


@pytest.fixture
def without_pitch(job: Path, browser: TestClient) -> dict[str, Any]:
    """Return the job as the page shows it when nobody has stated the pitch of the screw."""
    text = job.read_text(encoding="utf-8")
    job.write_text(text.replace(", screw_pitch: 10", ""), encoding="utf-8")
    found: dict[str, Any] = browser.get("/api/job").json()
    return found


def test_a_job_that_states_its_pitch_is_not_asked_for_it(before: dict[str, Any]) -> None:
    assert "screw_pitch" not in [each["key"] for each in before["asked"]]


def test_the_pitch_is_asked_for_and_written_into_the_job(
    job: Path, browser: TestClient, without_pitch: dict[str, Any]
) -> None:
    pitch = without_pitch["asked"][0]
    assert pitch | {"key": "screw_pitch", "name": "Screw pitch", "unit": "mm"} == pitch
    assert "screw-pitch" in pitch["effects"]
    after = click(browser, without_pitch, action="state", stated={"axis.screw_pitch": 10})
    assert "travel: [0, 600], screw_pitch: 10}" in job.read_text(encoding="utf-8")
    assert "screw-pitch" in [each["effect"] for each in after["others"]]
    assert after["undo"] == "axis.screw_pitch stated"
    german = browser.get("/api/job", params={"lang": "de"}).json()
    assert german["undo"] == "Spindelsteigung angegeben"
    assert german["steps"][0]["text"] == "Spindelsteigung angegeben"


@pytest.mark.parametrize(
    "stated",
    [{"axis.screw_pitch": 0}, {"axis.screw_pitch": " "}, {"axis.travel": 10}, {"__class__": 1}, {}, {"": ""}],
)
def test_nothing_but_what_is_asked_for_is_written(
    browser: TestClient, without_pitch: dict[str, Any], stated: dict[str, Any]
) -> None:
    refused(browser, without_pitch, action="state", stated=stated)
