"""Schema and program agree: what an editor passes, the check takes, key by key."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from job.jobs import list_groups, make_editor, mistakes
from zlmreport.plugin.extension import JobKeys

VALIDATOR = make_editor()
SCHEMA = VALIDATOR.schema
SOUND: dict[str, Any] = {
    "schema": "zlmreport/job/1",
    "certificate": {"number": "R-1", "kind": "report"},
    "axis": {"name": "X", "travel": [0, 300]},
    "measurement": {"source": {"plugin": "exemplary-text", "file": "six.txt"}},
    "evaluate": ["exemplary:1"],
    "output": {"formats": ["exemplary"]},
}
#: What keys are tried with: numbers at and beyond every bound, texts that are none or no line.
VALUES = (-1, 0, 1e-13, 0.5, 1, 30, 1e10, "", " ", "word", "two\nlines", "a\ttab", "-1", True, None)
#: Of these what the program takes and a schema does not say: a word or a number as it is spelt.
SPELT = (0, 1, "-1", True)
#: Keys whose value is right or wrong by other keys, by files, or by what is installed.
BY_OTHERS = (
    *("measurement.error", "measurement.end", "location.kind", "next_due", "as_found", "extends", "fleet"),
    *("axis.compensation_table", "axis.angular_errors", "laboratory.logo", "certificate.signature"),
    *("certificate.style", "certificate.amends", "certificate.kind", "certificate.layout"),
    *("measurement.source", "compensation.controller", "model.priors", "output.directory", "circle"),
    *("plan.circle", "uncertainty.calibrated_length", "uncertainty.centring"),  # of a circle alone
)
Path = tuple[str, ...]


def _resolved(part: dict[str, Any]) -> dict[str, Any]:
    while "$ref" in part:
        part = {
            **SCHEMA["$defs"][part["$ref"].rpartition("/")[2]],
            **{k: v for k, v in part.items() if k != "$ref"},
        }
    return part


def _alternatives(part: dict[str, Any]) -> list[dict[str, Any]]:
    whole = _resolved(part)
    return [whole, *(_resolved(each) for name in ("anyOf", "oneOf") for each in whole.get(name, ()))]


def _keys(part: dict[str, Any], path: Path = ()) -> Iterator[Path]:
    """Yield the paths of keys that hold a number, a text or the like."""
    for group in _alternatives(part):
        for name, value in group.get("properties", {}).items():
            inner = [each for each in _alternatives(value) if "properties" in each]
            if any(each.get("type") not in ("array", "object", None) for each in _alternatives(value)):
                yield (*path, name)
            if inner and len(path) < 3:
                yield from _keys(value, (*path, name))


PATHS = sorted(
    {path for path in _keys(SCHEMA) if not ".".join(path).startswith(BY_OTHERS) and path[0] != "schema"}
)


def _with(path: Path, value: object) -> dict[str, Any]:
    """Return the sound job with one key set; groups on the way get what they must have."""
    job: dict[str, Any] = copy.deepcopy(SOUND)
    group, part = job, SCHEMA
    for name in path[:-1]:
        part = next(
            each["properties"][name] for each in _alternatives(part) if name in each.get("properties", {})
        )
        if not isinstance(group.get(name), dict):
            group[name] = _least(part)
        group = group[name]
    group[path[-1]] = value
    return job


def _least(part: dict[str, Any]) -> dict[str, Any]:
    """Return the least that a group of keys may hold: examples of what it must have."""
    group = next(each for each in _alternatives(part) if "properties" in each)
    found = {}
    for name in _required(group):
        value = _resolved(group["properties"][name])
        found[name] = next(iter(value.get("examples") or value.get("enum") or [value.get("const", 1)]))
    return found


def _required(group: dict[str, Any]) -> list[str]:
    """Return the keys that a group must have; the schema of a part of a job does not say so."""
    title = group.get("title", "")
    model = next((each for each in list_groups(JobKeys) if each.__name__ == title), None)
    if model is None:
        return list(group.get("required", ()))
    return [info.alias or name for name, info in model.model_fields.items() if info.is_required()]


def test_many_keys_are_tried() -> None:
    assert len(PATHS) > 80
    assert ("instrument", "expanded_uncertainty") in PATHS


@pytest.mark.long
@given(path=st.sampled_from(PATHS), value=st.sampled_from(VALUES))
@settings(max_examples=300)
def test_a_value_that_fits_is_taken_and_one_that_does_not_is_refused(
    tmp_path_factory: pytest.TempPathFactory, path: Path, value: object
) -> None:
    job = _with(path, value)
    found = mistakes(json.dumps(job), tmp_path_factory.getbasetemp())
    wrong = [error.message for error in VALIDATOR.iter_errors(job)]
    if wrong and not found:
        assert value in SPELT, (".".join(path), value, wrong)
    else:
        assert bool(found) == bool(wrong), (".".join(path), value, found)
