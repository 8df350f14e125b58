"""A job in which every text is somebody's attempt at something."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import yaml

from zlmreport.job.types import LINE_FORM, LINES_FORM
from zlmreport.plugin.extension import JobKeys

Path = tuple[str, ...]

#: Keys whose texts name something that must exist: a hostile one is refused.
NAMES = {
    ("certificate", "style", "accent"),  # a colour
    ("extends",),
    ("extends", "[]"),
    ("provided_by_customer", "[]"),
    ("external", "[]", "keys", "[]"),
    ("model", "effects", "[]"),
    ("output", "formats", "[]"),
}
#: The last part of others of that kind.
IDENTIFIERS = {"controller", "error", "plugin", "program", "standard"}
#: A short way to write a key that has a longer one, which is used here.
SHORT = {("location",)}


def text_keys() -> dict[Path, int]:
    """Return the keys of a job whose values are free text, with the length that each may have.

    Those of `circle` are left out: a job measures an axis or a circle.
    """
    return {path: room for path, room in _free_texts().items() if path[0] != "circle"}


def circle_text_keys() -> dict[Path, int]:
    """Return the keys of `circle` whose values are free text, with the length that each may have."""
    return {path: room for path, room in _free_texts().items() if path[0] == "circle"}


def _free_texts() -> dict[Path, int]:
    schema = JobKeys.model_json_schema()
    return {
        path: part["maxLength"]
        for path, part in _strings(schema, schema, ())
        if path not in NAMES | SHORT and path[-1] not in IDENTIFIERS
    }


def _strings(
    schema: dict[str, Any], part: dict[str, Any], path: Path
) -> Iterator[tuple[Path, dict[str, Any]]]:
    if "$ref" in part:
        part = schema["$defs"][part["$ref"].rpartition("/")[2]]
    is_free = part.get("pattern") in {None, LINE_FORM, LINES_FORM}
    if part.get("type") == "string" and is_free and not {"enum", "const", "format"} & set(part):
        yield path, part
    for key, value in part.get("properties", {}).items():
        yield from _strings(schema, value, (*path, key))
    for each in part.get("anyOf", ()):
        yield from _strings(schema, each, path)
    if isinstance(part.get("items"), dict):
        yield from _strings(schema, part["items"], (*path, "[]"))


def job_with(text_of: Callable[[Path], str]) -> str:
    """Return a job that states every text it can state."""
    job: dict[str, Any] = {
        "schema": "zlmreport/job/1",
        "certificate": {
            "number": "CAL-1",
            "issued": "2026-11-20",
            "kind": "report",
            "sections": [{}, "results"],
        },
        "laboratory": {"country": "DE"},
        "location": {"kind": "laboratory"},
        "axis": {"kind": "linear", "travel": [0, 100]},
        "measurement": {"date": "2026-11-18", **_measurement()},
        "as_found": {"measurement": {"date": "2026-11-17", **_measurement()}},
        "instrument": {},
        "evaluate": [{"standard": "nmtba", "tolerances": {"P": 20}}],
        "opinions": [{}],
        "external": [{"keys": ["environment"]}],
        "provided_by_customer": ["machine"],
        "uncertainty": {"contributions": [{"acts": "at-each-reading", "standard_uncertainty": 0.1}]},
    }
    for path in text_keys():
        _state(job, path, text_of(path))
    return yaml.safe_dump(job, allow_unicode=True, sort_keys=False, width=1_000_000)


def circular_job_with(text_of: Callable[[Path], str]) -> str:
    """Return a job of a circular test that states every text of its circle."""
    job: dict[str, Any] = {
        "schema": "zlmreport/job/1",
        "certificate": {"number": "CAL-2", "issued": "2026-11-20", "kind": "report"},
        "circle": {"radius": 150, "feed": 1000, "calibrated_length": True},
        "measurement": {
            "date": "2026-11-18",
            "source": {"plugin": "circle-csv", "file": "circle.csv"},
        },
        "evaluate": [{"standard": "iso230-4:2005"}],
    }
    for path in circle_text_keys():
        _state(job, path, text_of(path))
    return yaml.safe_dump(job, allow_unicode=True, sort_keys=False, width=1_000_000)


def _measurement() -> dict[str, Any]:
    return {
        "source": {"plugin": "laser-csv", "file": "x-axis.csv"},
        "plane": {"at": 200},
        "excluded": [{"target": 25, "direction": "+", "run": 3}],
    }


def _state(job: Any, path: Path, text: str) -> None:
    *parents, last = path
    for key, following in zip(parents, path[1:], strict=True):
        job = job[0] if key == "[]" else job.setdefault(key, [{}] if following == "[]" else {})
    if last == "[]":
        job[:] = [text]
    else:
        job[last] = text


#: Readings with a column that is nobody's but the hostile one's.
READINGS = "target,direction,run,deviation\n" + "".join(
    f"{target},{direction},{run},{run + target / 50}\n"
    for run in (1, 2, 3)
    for direction, targets in (("+", (0, 25, 50, 75, 100)), ("-", (100, 75, 50, 25, 0)))
    for target in targets
)

#: One turn in each sense, a reading every ten degrees.
CIRCLE = "sense,run,angle,deviation\n" + "".join(
    f"{sense},1,{angle},{angle % 40 / 10}\n"
    for sense, angles in (("ccw", range(0, 361, 10)), ("cw", range(360, -1, -10)))
    for angle in angles
)
