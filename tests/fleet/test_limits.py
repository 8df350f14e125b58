"""A job that hangs or grows is stopped alone, and set aside when it does so again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import pytest

from fleet.fleets import FLEET, Fleet, Here, Witness, without_processes
from zlmreport.fleet import night
from zlmreport.fleet.issuing import What
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.making import Failed, MadeCertificate, Task
from zlmreport.fleet.records import State
from zlmreport.fleet.state import describe_state
from zlmreport.plugin import Place, Problem

HANGING = """\
import time

from offers import offering
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard


class Hanging(ExemplaryRenderer):
    suffix = ".txt"

    def render(self, certificate):
        if certificate.number == "CAL-HANGS":
            time.sleep(1e6)
        if certificate.number == "CAL-GROWS":
            bytearray(10**10)
        return certificate.number.encode()


offer = offering([ExemplaryStandard()], [ExemplarySource()], [Hanging()])
zlmreport_standards = offer.zlmreport_standards
zlmreport_sources = offer.zlmreport_sources
zlmreport_renderers = offer.zlmreport_renderers
"""


def limited(folder: Path, stem: str, limits: str) -> Witness:
    """Spend a night with a job that does what its name says, under limits."""
    fleet = Fleet.of(folder, stem)
    fleet.write("fleet.yaml", f"{FLEET}limits: {{{limits}}}\n")
    plugin = fleet.write("hanging.py", HANGING)
    witness = Witness()
    night.spend_night(fleet.file, night.Order((plugin,), workers=1), witness)
    assert witness.what[stem] is What.FAILED
    return witness


def test_a_job_that_hangs_is_stopped(tmp_path: Path) -> None:
    witness = limited(tmp_path, "hangs", "seconds: 5")
    assert witness.of("hangs").problems[0].message == (
        "was stopped: it was not made within 5 s, the limit of a job"
    )


def test_a_job_that_grows_is_stopped(tmp_path: Path) -> None:
    """Whatever time it takes on a busy machine: the limit of the others is for who hangs."""
    witness = limited(tmp_path, "grows", "megabytes: 2000")
    assert "it needs more than 2000 MB, the limit of a job" in witness.of("grows").problems[0].message


class Stopping(Here):
    """Stops every job."""

    def make_all(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed]]:
        for task in tasks:
            yield task, Failed((Problem(Place(str(task.job)), "was stopped"),), is_stopped=True)


@pytest.fixture
def stopping(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fleet:
    without_processes(monkeypatch)
    monkeypatch.setattr(night, "make_executor", lambda *_: Stopping())
    return Fleet.of(tmp_path, "x")


def test_what_is_stopped_twice_is_set_aside_until_its_inputs_change(stopping: Fleet) -> None:
    assert stopping.spend().what == {"x": What.FAILED}
    assert "set aside until" in stopping.spend().of("x").problems[0].message
    aside = stopping.spend().of("x")
    assert aside.what is What.SET_ASIDE
    assert aside.problems[0].message.startswith("was stopped; it is set aside until")
    assert [each.state for each in stopping.entries()] == [State.STOPPED, State.SET_ASIDE]
    stopping.readings("x", "2 2 3 -1 -2 -3")
    assert stopping.spend().what == {"x": What.FAILED}
    assert stopping.entries()[-1].state is State.STOPPED


def test_what_is_set_aside_is_tried_again_when_a_template_changes(stopping: Fleet) -> None:
    template = stopping.write("jobs/look/style.css", "h2 { letter-spacing: 0 }")
    stopping.job("x", ("  language: en\n", "  language: en\n  style: {templates: look}\n"))
    assert [stopping.spend().what["x"] for _ in range(3)] == [What.FAILED, What.FAILED, What.SET_ASIDE]
    template.write_text("h2 { letter-spacing: 1pt }", encoding="utf-8")
    assert stopping.spend().what == {"x": What.FAILED}


def test_what_is_set_aside_still_needs_somebody(stopping: Fleet) -> None:
    stopping.spend()
    stopping.spend()
    state = describe_state("Hall North", stopping.entries(), ["jobs/x.yaml"], None)
    assert [each.entry.number for each in state.failures] == ["CAL-X"]
    assert state.counts["failed"] == 1


def test_a_job_may_take_ten_times_as_long_as_it_ever_took(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_processes(monkeypatch)
    fleet = Fleet.of(tmp_path, "x")
    limits = []

    class Slow(Here):
        def make_all(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed]]:
            for task, made in super().make_all(tasks):
                limits.append(task.limits.seconds)
                object.__setattr__(made, "seconds", 300.0)
                yield task, made

    monkeypatch.setattr(night, "make_executor", lambda *_: Slow())
    fleet.spend()
    fleet.readings("x", "2 2 3 -1 -2 -3")
    fleet.spend()
    assert limits == [600.0, 3000.0]


def count_jobs(fleet: Fleet) -> Mapping[str, int]:
    """Return what became of the two jobs in the last night, as the fleet's page has it."""
    with Ledger.open(fleet.file.ledger, fleet.file.name) as ledger:
        last = ledger.find_last_night()
    return describe_state("Hall North", fleet.entries(), ["jobs/x.yaml", "jobs/y.yaml"], last).counts


def test_after_its_time_a_night_begins_no_job_and_says_what_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_processes(monkeypatch)
    fleet = Fleet.of(tmp_path, "x", "y")
    witness = Witness()
    night.spend_night(fleet.file, night.Order(seconds=0.0), witness)
    assert witness.what == {"x": What.LEFT, "y": What.LEFT}
    assert [each.english for each in witness.notices] == [
        "the time of the night was over before 2 of 2 jobs; they are for the next night"
    ]
    counts = count_jobs(fleet)
    assert (counts["left"], counts["unchanged"]) == (2, 0)
    assert fleet.spend().what == {"x": What.ISSUED, "y": What.ISSUED}
    counts = count_jobs(fleet)
    assert (counts["left"], counts["made"]) == (0, 2)
