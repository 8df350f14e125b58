"""A month of nights in which everything goes wrong that can, in an order that a seed chooses.

At its end every document is right, every event was told once, and nothing was told that did not happen.
Kills by the system are real in `test_killed.py`; here a night ends at any of its events.
"""

from __future__ import annotations

import random
import shutil
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from fleet.fleets import FLEET, Fleet, Here, Witness, without_processes
from fleet.test_news import NOTIFY, Post, on_a_day, post_office
from zlmreport.fleet import issuing, making, night
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.making import Failed, MadeCertificate, Task, report_late
from zlmreport.fleet.night import MissingError

#: Axis 2 has a test that hangs, 3 gets another instrument, 4 another one and a step with it, 5 drifts.
AXES = 6
HANGING, STEPPING, DRIFTING, REPLACED = 2, 4, 5, (3, 4)
CHANGES_AT = 7
#: Days on which all axes are measured.
MEASURED = range(1, 29, 3)
#: What is told: each of these once, a hanging test when it hangs and when it is set aside, and a full disk
#: for each test of its day. That axis 3 has another instrument, and nothing else of it changed, is no news.
TOLD = {
    "folder": 1,
    "clock": 1,
    "broken": 2,
    "document": 1,
    "lost": 1,
    "hangs": 1,
    "aside": 1,
    "step with its instrument": 1,
    "drift": 1,
    "disk": AXES,
}


class KilledError(Exception):
    """A night ends anywhere."""


@dataclass(slots=True)
class Deadly(Witness):
    """Kills a night at the first job of which something becomes."""

    def note_happened(self, happened: Happened) -> None:
        Witness.note_happened(self, happened)
        if happened.what is not What.UNCHANGED:
            raise KilledError


@dataclass(slots=True)
class Hanging(Here):
    """Makes certificates in this process; one job never comes to its end."""

    stem: str

    def make_all(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed]]:
        for task in tasks:
            hangs = task.job.stem == self.stem
            yield task, report_late(task) if hangs else making.make_certificate(task)


def schedule(rng: random.Random) -> dict[int, str]:
    """Return what goes wrong, by day: in any order, but that a lost job is found after it was lost."""
    full = rng.choice(MEASURED[3:-1])
    hang = rng.choice([day for day in MEASURED[2:6] if day != full])
    free = [day for day in range(5, 28) if day not in {*MEASURED, full - 1}]
    *others, lost, found = rng.sample(free, 7)
    troubles = dict(zip(others, ("kill", "kill", "mount", "clock", "document"), strict=True))
    lost, found = sorted((lost, found))
    return {**troubles, lost: "lost", found: "found", full: "disk", hang: "hang"}


@dataclass(slots=True)
class Month:
    """A fleet with its tests and what goes wrong."""

    fleet: Fleet
    rng: random.Random
    measured: list[int] = field(default_factory=lambda: [0] * AXES)
    hanging: str = ""

    def measure(self, axes: Iterable[int]) -> None:
        """Write the job of a test."""
        for axis in axes:
            self.measured[axis] += 1
            number = self.measured[axis]
            value = 6 + self.rng.uniform(-0.3, 0.3)
            is_changed = number >= CHANGES_AT
            value += 10 if axis == STEPPING and is_changed else 1.2 * number if axis == DRIFTING else 0
            laser = "L2" if axis in REPLACED and is_changed else "L1"
            changes = (
                ("name: X", f"name: A{axis}"),
                ("2026-11-18", f"2025-{number:02}-15"),
                ("evaluate:", f"instrument: {{name: Laser, serial: {laser}}}\nevaluate:"),
            )
            self.fleet.job(f"a{axis}t{number}", *changes, readings=f"0 1 {min(value, 19.5):.3f} 0 1 2")

    def spend(self, trouble: str, monkeypatch: pytest.MonkeyPatch) -> None:
        """Spend a night with what goes wrong in it."""
        folder = self.fleet.folder
        if trouble == "mount":
            (folder / "certificates").rename(folder / "elsewhere")
            with pytest.raises(MissingError):
                self.fleet.spend()
            (folder / "elsewhere").rename(folder / "certificates")
        elif trouble == "lost":
            shutil.move(folder / "jobs/a1t1.yaml", folder / "lost.yaml")
        elif trouble == "found":
            shutil.move(folder / "lost.yaml", folder / "jobs/a1t1.yaml")
        elif trouble == "document":
            self.fleet.write("fleet.yaml", f"{FLEET}{NOTIFY}retired: [jobs/a0t1.yaml]\n")
            (folder / "certificates/17/A0/CAL-A0T1.txt").rename(folder / "CAL-A0T1.txt")
        elif trouble == "clock":
            on_a_day(2, monkeypatch)
        elif trouble == "disk":
            monkeypatch.setattr(issuing, "lay", full)
        elif trouble == "hang":
            self.hanging = f"a{HANGING}t{self.measured[HANGING]}"
        monkeypatch.setattr(night, "make_executor", lambda *_: Hanging(self.hanging))
        if trouble == "kill":
            self.measure([0, 1])
            with pytest.raises(KilledError):
                night.spend_night(self.fleet.file, night.Order(), Deadly())
        else:
            self.fleet.spend()
        if trouble == "document":
            (folder / "CAL-A0T1.txt").rename(folder / "certificates/17/A0/CAL-A0T1.txt")

    def mend(self) -> None:
        """Write the test that hangs anew, so that it does no more."""
        self.fleet.readings(self.hanging, "0 1 6 0 1 2")
        self.hanging = ""


def full(*_: object) -> None:
    raise OSError(28, "No space left on device")


def kind_of(line: str) -> str:
    words = {
        "the folder is empty": "folder",
        "the clock stands": "clock",
        "was broken off": "broken",
        "made again by no job": "document",
        "the job is gone": "lost",
        "it is set aside until": "aside",
        "the limit of a job": "hangs",
        "No space": "disk",
        " a year": "drift",
        "measured with Laser L2 in place of Laser L1": "step with its instrument",
    }
    return next((kind for word, kind in words.items() if word in line), line)


@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2, 3, 10])
def test_every_document_is_right_and_every_event_told_once(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_processes(monkeypatch)
    post: Post = post_office(monkeypatch)
    rng = random.Random(seed)
    troubles, month = schedule(rng), Month(Fleet.of(tmp_path), rng)
    fleet, written = month.fleet, dict[str, bytes]()
    fleet.write("fleet.yaml", FLEET + NOTIFY)
    for day in range(1, 31):
        on_a_day(day, monkeypatch)
        month.measure(range(AXES) if day in MEASURED else ())
        with monkeypatch.context() as patched:
            month.spend(troubles.get(day, ""), patched)
        if day == MEASURED[-1]:
            month.mend()
        for path in (fleet.folder / "certificates").rglob("*.txt"):
            content = path.read_bytes()
            assert written.setdefault(path.name, content) == content
    numbers = {f"CAL-A{axis}T{one}" for axis in range(AXES) for one in range(1, month.measured[axis] + 1)}
    assert fleet.files() == {f"{number}.txt" for number in numbers}
    with Ledger.open(fleet.file.ledger, "Hall North") as ledger:
        assert set(ledger.list_certificates()) == numbers
    assert Counter(map(kind_of, post.lines)) == TOLD
    assert set(post.lines.values()) == {1}
