"""An effect that repeats is shown on one of its periods."""

from __future__ import annotations

import numpy as np
from starlette.testclient import TestClient


def test_a_candidate_is_one_wave_over_the_pitch(browser: TestClient) -> None:
    wave = browser.get("/api/folded", params={"of": "screw-pitch", "lang": "de"}).json()["wave"]
    assert wave["range"] == [0.0, 10.0]
    assert wave["xTitle"] == "Position innerhalb von 10 mm"
    assert 0 <= min(wave["x"]) <= max(wave["x"]) <= 10


def test_the_readings_lie_on_the_wave_but_for_the_noise(browser: TestClient) -> None:
    wave = browser.get("/api/folded", params={"of": "screw-pitch"}).json()["wave"]
    (curve,) = (each for each in wave["curves"] if each["direction"] == 1)
    apart = np.array(wave["y"]) - np.interp(wave["x"], curve["x"], curve["y"])
    assert np.std(wave["y"]) > 1.4
    assert np.std(apart) < 0.6


def test_the_wave_of_an_effect_of_the_model_is_that_of_the_candidate(browser: TestClient) -> None:
    before = browser.get("/api/folded", params={"of": "screw-pitch"}).json()["wave"]
    digest = browser.get("/api/job").json()["digest"]
    added = {"based_on": digest, "action": "add", "effect": "screw-pitch"}
    assert browser.post("/api/change", json=added).is_success
    assert browser.get("/api/folded", params={"of": "screw-pitch"}).json()["wave"] == before


def test_what_does_not_repeat_has_no_wave(browser: TestClient) -> None:
    assert browser.get("/api/folded", params={"of": "backlash"}).json() == {"wave": None}


def test_an_effect_that_there_is_not_is_said(browser: TestClient) -> None:
    assert browser.get("/api/folded", params={"of": "none-such"}).status_code == 422
