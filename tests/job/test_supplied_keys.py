"""Keys whose values others supplied: known, and stated."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import mistakes, with_lines
from zlmreport.job.contradictions import list_markable_keys


@pytest.mark.parametrize(
    "key", ["machine.serial", "machine", "axis.travel", "measurement.source", "evaluate.tolerances"]
)
def test_a_key_that_the_job_states_may_be_the_customers(key: str, tmp_path: Path) -> None:
    assert mistakes(with_lines(f"provided_by_customer: [{key}]"), tmp_path) == []


@pytest.mark.parametrize(
    ("key", "nearest"),
    [
        ("machine.seriall", "machine.serial"),
        ("environment.expansion_coeficient", "environment.expansion_coefficient"),
        ("evaluate.tolerance", "evaluate.tolerances"),
        ("machin", "machine"),
    ],
)
def test_a_misspelt_key_is_answered_with_the_nearest(key: str, nearest: str, tmp_path: Path) -> None:
    (found,) = mistakes(with_lines(f"provided_by_customer: [{key}]"), tmp_path)
    assert found.startswith(f"job.yaml:16:24: provided_by_customer: '{key}' is no key whose value others can")
    assert f"did you mean '{nearest}'?" in found


@pytest.mark.parametrize(
    "key", ["certificate.number", "laboratory.name", "output.directory", "decision_rule"]
)
def test_the_laboratory_answers_for_its_own_keys(key: str, tmp_path: Path) -> None:
    (found,) = mistakes(with_lines(f"provided_by_customer: [{key}]"), tmp_path)
    assert "is no key whose value others can supply" in found


def test_a_key_that_the_job_does_not_state_cannot_be_the_customers(tmp_path: Path) -> None:
    (found,) = mistakes(with_lines("provided_by_customer: [machine.model]"), tmp_path)
    assert found.endswith("this job does not state machine.model; state it, or do not list it")


def test_keys_of_external_providers_are_held_against_the_job_too(tmp_path: Path) -> None:
    line = "external: [{results: temperatures, provider: Thermometry Ltd, keys: [machine.seriall]}]"
    (found,) = mistakes(with_lines(line), tmp_path)
    assert found.startswith("job.yaml:16:70: external.keys: 'machine.seriall' is no key")


def test_keys_are_named_through_groups_and_lists() -> None:
    known = list_markable_keys()
    assert {"environment", "environment.air_temperature", "evaluate.tolerances"} <= set(known)
    assert not any(key.startswith(("certificate", "output", "laboratory")) for key in known)
