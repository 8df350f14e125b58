"""The staircase of a build: nothing of it is written before a step is taken."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from installed import registry
from processes import awaited
from zlmreport.job.loading import load
from zlmreport.plugin import Language
from zlmreport.web.naming import Naming
from zlmreport.web.view import add_stairs, make_stairs

STEP: dict[str, Any] = {
    "effect": "backlash",
    "settings": {},
    "rms_before": 4.0,
    "rms_after": 1.0,
    "noise_rms": 0.5,
}


def test_each_step_says_how_far_the_error_falls(job: Path) -> None:
    steps = [STEP, {**STEP, "effect": "screw-pitch", "rms_before": 1.0, "rms_after": 0.5}]
    effects = registry().effects
    first, second = make_stairs(steps, load(job, registry()), registry(), Naming.of(effects, Language.GERMAN))
    assert (first["name"], first["before"], first["after"]) == ("+ Umkehrspanne", "4,00 µm", "1,00 µm")
    assert (first["share"], second["share"], second["floor"]) == (0.25, 0.125, 0.125)


def test_a_step_names_those_that_the_readings_do_not_tell_from_it(job: Path) -> None:
    steps = [{**STEP, "indistinguishable_from": ["screw-pitch"]}]
    effects = registry().effects
    (step,) = make_stairs(steps, load(job, registry()), registry(), Naming.of(effects, Language.GERMAN))
    assert step["name"] == "+ Umkehrspanne oder Periodischer Steigungsfehler der Spindel"


def test_what_goes_out_again_has_a_minus_and_an_unknown_noise_no_mark(job: Path) -> None:
    (step,) = make_stairs(
        [{**STEP, "removed": True, "noise_rms": None}],
        load(job, registry()),
        registry(),
        Naming.of(registry().effects, Language.ENGLISH),
    )
    assert (step["name"], step["removed"], step["floor"]) == ("− backlash", True, None)


def test_an_effect_is_named_with_its_unusual_keys_alone(job: Path) -> None:
    usual = registry().effect("polynomial").settings.model_dump(mode="json")
    names = Naming.of(registry().effects, Language.ENGLISH)

    def of(settings: dict[str, Any]) -> str:
        steps = [{**STEP, "effect": "polynomial", "settings": settings}]
        return str(make_stairs(steps, load(job, registry()), registry(), names)[0]["argument"])

    assert of(usual) == "polynomial"
    assert of({**usual, "order": 5}) == 'polynomial: {"order": 5}'


def test_what_is_no_build_stays_as_it_is(job: Path) -> None:
    state = {"state": "making", "seconds": 1.0}
    assert add_stairs(state, load(job, registry()), registry(), Language.ENGLISH) == state


@pytest.mark.long
def test_a_build_is_a_proposal_whose_steps_are_taken_one_by_one(job: Path, browser: TestClient) -> None:
    text = job.read_text("utf-8")
    assert browser.post("/api/made/build", json={}).json()["state"] == "making"
    found = awaited(lambda: (s := browser.get("/api/made/build").json())["state"] == "made" and s)
    assert [each["name"] for each in found["stairs"]] == ["+ screw-pitch"]
    assert job.read_text("utf-8") == text
    digest = browser.get("/api/job").json()["digest"]
    taken = {"based_on": digest, "action": "add", "effect": found["stairs"][0]["argument"]}
    assert browser.post("/api/change", json=taken).is_success
    assert "    - screw-pitch\n" in job.read_text("utf-8")


def test_a_build_is_stopped(browser: TestClient) -> None:
    browser.post("/api/made/build", json={})
    assert browser.post("/api/made/build/stop", json={}).is_success
    assert browser.get("/api/made/build").json() == {"state": "none"}


def test_what_is_not_made_here_is_not_stopped(browser: TestClient) -> None:
    assert browser.post("/api/made/none-such/stop", json={}).status_code == 404
