"""``zlmreport capture --steered``: another program reads what happens, and orders."""

from __future__ import annotations

import io
import json
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from cli.commands import Run
from cli.test_capture import JOB, PLUGIN, WHOLE
from zlmreport.cli import main
from zlmreport.live.capture.events import Commented, Interrupted
from zlmreport.plugin.instrument import read_journal


class AtOnce:
    """A thread that has done its work when it is started: what is ordered is there before any reading."""

    def __init__(self, target: Callable[[], None], **_: object) -> None:
        self._target = target

    def start(self) -> None:
        self._target()


@pytest.fixture
def steered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[[str], Run]:
    """Return a capture of four visits to which lines are sent before it begins."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("zlmreport.cli.capture_display.Thread", AtOnce)
    Path("job.yaml").write_text(JOB.replace("MOVES", WHOLE), encoding="utf-8")

    def run(lines: str) -> Run:
        monkeypatch.setattr("sys.stdin", io.StringIO(lines))
        code = main(["capture", "job.yaml", "--steered", "--plugin", str(PLUGIN)])
        return Run(code, *capsys.readouterr())

    return run


def _records(run: Run) -> list[dict[str, object]]:
    return [json.loads(line) for line in run.output.splitlines()]


def test_an_order_is_carried_out_and_what_is_none_is_refused(steered: Callable[[str], Run]) -> None:
    run = steered("c coolant on\ndance\n")
    told = {str(each["record"]): each for each in _records(run)}
    assert told["comment"]["line"] == "comment  coolant on"
    assert "'dance' is no order" in str(told["refused"]["message"])


def test_the_first_record_says_what_to_do(steered: Callable[[str], Run]) -> None:
    first, *_ = _records(steered(""))
    assert first["record"] == "to-do"
    assert first["steps"] == [
        "let the axis stand still at −5.000 mm, for the datum",
        "start the program at visit 1: 0.000 mm from below, run 1",
    ]


def test_the_end_of_the_orders_interrupts_the_capture(steered: Callable[[str], Run]) -> None:
    before = threading.active_count()
    assert steered("c coolant on\n").code == 130
    assert threading.active_count() == before  # nobody asks the instrument any more
    history = read_journal(Path("x.journal"))
    assert history is not None
    assert [type(each.event) for each in history.entries] == [Commented, Interrupted]
