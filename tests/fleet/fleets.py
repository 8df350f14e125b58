"""Fleets of small jobs, whose nights are spent in this process."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

import pytest

from job.jobs import SOUND
from offers import offering
from replacing import replaced
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from zlmreport.fleet import making, night
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.making import Failed, MadeCertificate, Task
from zlmreport.fleet.plan import PlannedJob
from zlmreport.fleet.records import LedgerEntry, NightNotice
from zlmreport.job.fleet import FleetFile, load_fleet
from zlmreport.plugin.registry import Plugin, collect
from zlmreport.plugin.renderer import Certificate

READINGS = "1 2 3 -1 -2 -3"
FLEET = """\
schema: zlmreport/fleet/1
name: Hall North
jobs: jobs/*.yaml
output: {directory: certificates, layout: "{serial}/{axis}"}
ledger: ledger.db
"""
VERSIONS = {"zlmreport": "0.1.0 code", "exemplary-plugins": "1.2 code", "the set of plugins": " all"}


class Page(ExemplaryRenderer):
    """A certificate in a few lines, which shows every change of what it was made from."""

    suffix = ".txt"

    def render(self, certificate: Certificate) -> bytes:
        lines = [certificate.title, certificate.page_words.number]
        lines.extend(f"{each.name} {each.file.sha256}" for each in certificate.sources)
        return "\n".join(lines).encode()


class Sheet(Page):
    """The same in a second file."""

    identifier = "exemplary-sheet"
    suffix = ".md"


class Again(Page):
    """The same by another program."""

    identifier = "exemplary-again"


REGISTRY = collect(
    [
        (
            Plugin("exemplary", "exemplary_module", "exemplary-plugins", "1.2"),
            offering([ExemplaryStandard()], [ExemplarySource()], [Page(), Sheet(), Again()]),
        )
    ]
)


class Here:
    """Makes certificates in this process, one after the other."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def make_all(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed]]:
        for task in tasks:
            yield task, making.make_certificate(task)


@dataclass(slots=True)
class Witness:
    """Remembers a night."""

    jobs: Sequence[PlannedJob] = ()
    seen: list[Happened] = field(default_factory=list)
    notices: list[NightNotice] = field(default_factory=list)
    priors: list[Path] = field(default_factory=list)

    def note_plan(self, jobs: Sequence[PlannedJob]) -> None:
        self.jobs = jobs

    def note_happened(self, happened: Happened) -> None:
        self.seen.append(happened)

    def note_notice(self, notice: NightNotice) -> None:
        self.notices.append(notice)

    def note_priors(self, file: Path) -> None:
        self.priors.append(file)

    @property
    def what(self) -> dict[str, What]:
        """What happened to each job, by its file's stem."""
        return {Path(each.job).stem: each.what for each in self.seen}

    def of(self, stem: str) -> Happened:
        """Return what happened to a job."""
        return next(each for each in self.seen if Path(each.job).stem == stem)


@dataclass(frozen=True, slots=True)
class Fleet:
    """A folder with a fleet."""

    folder: Path

    @classmethod
    def of(cls, folder: Path, *numbers: str) -> Self:
        """Return a fleet with a job for each number, `x` with ``CAL-X``."""
        fleet = cls(folder)
        fleet.write("fleet.yaml", FLEET)
        for number in numbers:
            fleet.job(number)
        return fleet

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def job(self, stem: str, *changes: tuple[str, str], readings: str = READINGS) -> Path:
        """Write a job with its readings; `changes` replace parts of its text."""
        own = (("CAL-1", f"CAL-{stem.upper()}"), ("six.txt", f"{stem}.txt"))
        self.write(f"jobs/{stem}.txt", readings)
        return self.write(f"jobs/{stem}.yaml", replaced(SOUND, *own, *changes))

    def readings(self, stem: str, text: str) -> None:
        """Write other readings."""
        self.write(f"jobs/{stem}.txt", text)

    @property
    def file(self) -> FleetFile:
        return load_fleet(self.folder / "fleet.yaml")

    def spend(self) -> Witness:
        """Spend a night."""
        witness = Witness()
        night.spend_night(self.file, night.Order(), witness)
        return witness

    def foretold(self) -> dict[str, PlannedJob]:
        """Return what a night would do about each job."""
        return {each.path.stem: each for each in night.foretell(self.file, ())}

    def entries(self) -> list[LedgerEntry]:
        with Ledger.open(self.file.ledger, self.file.name) as ledger:
            return list(ledger.list_entries())

    def certificate(self, stem: str, suffix: str = ".txt") -> Path:
        return self.folder / f"certificates/17/X/CAL-{stem.upper()}{suffix}"

    def files(self) -> set[str]:
        """Return the names of all files among the certificates, hidden ones too."""
        return {path.name for path in (self.folder / "certificates").rglob("*") if path.is_file()}


def without_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let nights be spent in this process, with exemplary plugins of known versions."""
    monkeypatch.setattr(night, "make_executor", lambda *_: Here())
    monkeypatch.setattr(making, "find_plugins_once", lambda _: REGISTRY)
    monkeypatch.setattr(making, "find_versions_once", lambda _: VERSIONS)
    monkeypatch.setattr(night, "find_program_versions", lambda **_: VERSIONS)
