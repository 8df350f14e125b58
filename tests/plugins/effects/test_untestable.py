"""What each effect says of a test that lacks what it needs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest

from plugins.effects.installed import EFFECTS, ROTARY_ONLY, design_for
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import Language
from zlmreport.plugin.effect import Design

LINEAR_ONLY = {
    *("cosine-error", "screw-pitch", "abbe", "scale-expansion", "screw-expansion", "thermal-growth"),
    *("air-index", "dead-path", "probe-radius", "gauge-misalignment"),
}
TWO_DIRECTIONS = ("backlash", "backlash-gradient", "backlash-bow", "directional-pitch")
LOGS = {
    "scale-expansion": ["axis_temperature"],
    "datum-temperature": ["axis_temperature"],
    "screw-expansion": ["screw_temperature"],
    "air-index": ["air_temperature", "air_pressure"],
    "dead-path": ["air_temperature", "air_pressure"],
    "probe-radius": ["face"],
    "gauge-misalignment": ["face"],
}
KEYS = {
    "screw-pitch": "screw_pitch",
    "directional-pitch": "screw_pitch",
    "encoder-interpolation": "signal_period",
    "compensation-sign": "compensation_table",
    "compensation-shift": "compensation_table",
    "abbe": "angular_errors",
}


def _reason(identifier: str, design: Design, language: Language = Language.ENGLISH) -> str | None:
    reason = EFFECTS[identifier].untestable(design)
    return reason.in_language(language) if reason else None


def _only(design: Design, rows: Iterable[bool]) -> Design:
    return select_readings(design, np.flatnonzero(np.array(rows)))


@pytest.mark.parametrize(
    ("identifier", "column"), [(name, each) for name, logs in LOGS.items() for each in logs]
)
def test_missing_log_is_named_by_its_column(identifier: str, column: str) -> None:
    design = design_for(identifier)
    without = {name: log for name, log in design.conditions.items() if name != column}
    reason = _reason(identifier, replace(design, conditions=without))
    assert reason == f"no column {column} was logged beside the readings"


def test_several_missing_logs_are_named_together() -> None:
    reason = _reason("air-index", replace(design_for("air-index"), conditions={}), Language.GERMAN)
    assert reason == (
        "die Spalten air_temperature, air_pressure wurden nicht neben den Messwerten aufgezeichnet"
    )


@pytest.mark.parametrize(("identifier", "key"), KEYS.items())
def test_what_the_job_does_not_state_is_named_by_its_key(identifier: str, key: str) -> None:
    design = design_for(identifier)
    reason = _reason(identifier, replace(design, axis=replace(design.axis, **{key: None})))
    assert reason == f"the job does not state axis.{key}"


@pytest.mark.parametrize("identifier", TWO_DIRECTIONS)
def test_one_direction_is_not_enough_for_a_gap_between_two(identifier: str) -> None:
    design = design_for(identifier)
    reason = _reason(identifier, _only(design, design.direction > 0))
    assert reason == "the targets were approached from one direction only"


@pytest.mark.parametrize("identifier", sorted(LINEAR_ONLY))
def test_effect_of_lengths_is_none_of_rotary_axes(identifier: str) -> None:
    assert _reason(identifier, design_for("eccentricity")) == "for linear axes only"


@pytest.mark.parametrize("identifier", sorted(ROTARY_ONLY))
def test_effect_of_a_turn_is_none_of_linear_axes(identifier: str) -> None:
    assert _reason(identifier, design_for("offset")) == "for rotary axes only"


@pytest.mark.parametrize(
    ("identifier", "least"),
    [("polynomial", 5), ("periodic", 6), ("scale-joint", 5), ("scale-kink", 5), ("backlash-bow", 3)],
)
def test_too_few_targets_are_counted(identifier: str, least: int) -> None:
    design = design_for(identifier)
    assert _reason(identifier, _only(design, design.target < least)) is None
    reason = _reason(identifier, _only(design, design.target < least - 1))
    assert reason == f"at least {least} target positions are needed; there are {least - 1}"


def test_two_runs_do_not_tell_which_stands_off() -> None:
    design = design_for("first-run")
    reason = _reason("first-run", _only(design, design.run <= 2))
    assert reason == "at least 3 runs are needed; there are 2"


@pytest.mark.parametrize("identifier", ["thermal-growth", "thermal-drift", "time-periodic", "datum-step"])
def test_effect_of_time_needs_time_to_pass(identifier: str) -> None:
    design = design_for(identifier)
    reason = _reason(identifier, replace(design, time=np.zeros_like(design.time)))
    assert reason == "no time passes between the first reading and the last"


def test_travel_of_less_than_a_turn_shows_no_pitch() -> None:
    design = design_for("screw-pitch")
    reason = _reason("screw-pitch", replace(design, axis=replace(design.axis, screw_pitch=2.0)))
    assert reason == "the measured travel is shorter than one period (axis.screw_pitch)"


def test_rows_counted_instead_of_timed_are_time_enough() -> None:
    design = design_for("thermal-drift")
    counted = replace(design, time=np.arange(len(design.time), dtype=float), time_is_counted=True)
    assert _reason("thermal-drift", counted) is None
