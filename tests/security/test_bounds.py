"""A text that no page could hold, or that hides what it is, is refused where it stands."""

from __future__ import annotations

from pathlib import Path

import pytest

from refusals import refused
from security.hostile import CIRCLE, READINGS, circle_text_keys, circular_job_with, job_with, text_keys
from zlmreport.job.loading import load
from zlmreport.plugin.registry import find_plugins

REGISTRY = find_plugins()
KEYS = {**text_keys(), **circle_text_keys()}


def _mistakes(folder: Path, key: tuple[str, ...], text: str) -> list[str]:
    """Load a job that is sound but for the text of one key."""
    write_job = circular_job_with if key in circle_text_keys() else job_with
    job = write_job(lambda path: text if path == key else "x")
    (folder / "job.yaml").write_text(job, encoding="utf-8")
    (folder / "x-axis.csv").write_text(READINGS, encoding="utf-8")
    (folder / "circle.csv").write_text(CIRCLE, encoding="utf-8")
    return [str(problem) for problem in refused(load, folder / "job.yaml", REGISTRY).problems]


def test_there_are_texts_to_test() -> None:
    assert len(KEYS) > 40


@pytest.mark.parametrize("key", KEYS, ids=".".join)
def test_a_text_of_100_000_characters_is_refused_at_its_place(key: tuple[str, ...], tmp_path: Path) -> None:
    (mistake,) = _mistakes(tmp_path, key, "W" * 100_000)
    assert key[-2 if key[-1] == "[]" else -1] in mistake
    assert f"text of at most {KEYS[key]:,} characters" in mistake
    assert len(mistake) < 500


@pytest.mark.parametrize(
    ("character", "name"),
    [
        ("\u202e", "invisible character U+202E"),  # turns what follows around
        ("\u2066", "invisible character U+2066"),
        ("\x00", "control character U+0000"),
        ("\x1b", "control character U+001B"),  # begins a command to a terminal
        ("\x07", "control character U+0007"),
        ("\x9b", "control character U+009B"),
    ],
)
def test_a_character_that_hides_something_is_refused_by_its_name(
    character: str, name: str, tmp_path: Path
) -> None:
    found = _mistakes(tmp_path, ("customer", "name"), f"before{character}after")
    assert any(name in mistake for mistake in found)
    assert all(mistake.isprintable() for mistake in found)


def test_a_name_that_is_written_from_right_to_left_is_taken(tmp_path: Path) -> None:
    job = job_with(lambda path: "חברה לדוגמה" if path == ("customer", "name") else "x")
    (tmp_path / "job.yaml").write_text(job, encoding="utf-8")
    keys = load(tmp_path / "job.yaml", REGISTRY).keys
    assert keys.customer is not None
    assert keys.customer.name == "חברה לדוגמה"
