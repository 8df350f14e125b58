"""The record beside a job: never altered, and what undo goes by."""

from __future__ import annotations

from pathlib import Path

import pytest

from zlmreport.errors import AccessError
from zlmreport.web.journal import BenchJournal, JournalStep, find_undoable, make_entry

CONTENTS = [b"a", b"b", b"c"]


def made(first: int, action: str = "add", subject: str = "offset") -> JournalStep:
    """Return the record of a step from one content to the next."""
    return make_entry(action, subject, (CONTENTS[first], CONTENTS[first + 1]), (2.0, 1.0))


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    journal = BenchJournal.of(tmp_path / "job.yaml")
    journal.append(made(0))
    journal.append(made(1, subject="Größe"))
    assert journal.path.name == "job.history.jsonl"
    assert [(each.subject, each.content) for each in journal.read_entries()] == [
        ("offset", b"a"),
        ("Größe", b"b"),
    ]


def test_a_job_that_nobody_clicked_on_has_no_record(tmp_path: Path) -> None:
    assert BenchJournal.of(tmp_path / "job.yaml").read_entries() == ()


@pytest.mark.parametrize(
    "line", ["", "{", "[]", "1", '{"schema": "other/1"}', '{"schema": "zlmreport/workbench-history/1"}']
)
def test_a_line_that_is_none_is_passed_over(tmp_path: Path, line: str) -> None:
    journal = BenchJournal.of(tmp_path / "job.yaml")
    journal.append(made(0))
    with journal.path.open("a", encoding="utf-8") as file:
        file.write(f"{line}\n")
    journal.append(made(1))
    assert len(journal.read_entries()) == 2


def test_a_record_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "job.history.jsonl").mkdir()
    with pytest.raises(AccessError, match="cannot be written"):
        BenchJournal.of(tmp_path / "job.yaml").append(made(0))


def test_the_last_step_can_be_undone_and_then_the_one_before() -> None:
    steps = (made(0), made(1))
    assert find_undoable(steps, steps[1].after) is steps[1]
    back = make_entry("undo", "add offset", (CONTENTS[2], CONTENTS[1]), (1.0, 2.0))
    assert find_undoable((*steps, back), back.after) is steps[0]


def test_nothing_can_be_undone_on_a_job_that_is_another_now() -> None:
    assert find_undoable((made(0),), "other") is None
    assert find_undoable((), "other") is None
