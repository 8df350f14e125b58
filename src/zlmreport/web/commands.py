"""What the page can have made (documents, table, confirmation, next job), as a command of the terminal."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from zlmreport.errors import InputError
from zlmreport.files import Document, write
from zlmreport.job.job import Job
from zlmreport.job.parse import is_named_as_yaml
from zlmreport.job.yaml_text import write_group
from zlmreport.language import Language
from zlmreport.plugin.protocols import Renderer
from zlmreport.web.bench import PLACE, Bench, Loaded
from zlmreport.web.changes import ShortText
from zlmreport.web.making import Making, make_documents, make_values

#: What answers by values alone.
_BY_VALUES = ("table", "confirmation", "experiment", "build")
#: Jobs beside this one that are offered as its second test.
_MOST = 200


class Wanted(BaseModel):
    """What a page wants made, as it sends it."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    formats: tuple[ShortText, ...] = ()  #: Of the certificate: identifiers of renderers.
    controller: ShortText = ""  #: Of the table and its confirmation: for which control.
    #: Of the table: between its rows, mm or degrees; the targets without it.
    step: float | None = Field(None, gt=0, allow_inf_nan=False)
    #: Of the table: whether a format that nobody tried on its control may be written.
    unconfirmed: bool = False
    effects: tuple[ShortText, ...] = ()  #: Of the experiment: those that it is to tell apart.
    #: Of the confirmation: the file of the second test's job, in the folder of this one.
    after: ShortText = ""


class FileCommands:
    """What a page can have made, and where the files of it lie."""

    __slots__ = ()

    making: Mapping[str, Making]  #: What is under way or done, by its name.

    def begin(self, name: str, wanted: Wanted) -> dict[str, Any]:
        """Begin to make something, and return how far it is.

        Raises `InputError` if a format, a control, an effect or a second test is none that the page offered.
        """
        raise NotImplementedError

    def find_file(self, name: str) -> Path | None:
        """Return where a file lies that was made from the page; None for any other name."""
        found = (each.find_file(name) for each in self.making.values())
        return next((path for path in found if path is not None and path.is_file()), None)

    def end(self) -> None:
        """End all that is under way."""
        for each in self.making.values():
            each.end()


@dataclass(slots=True)
class Commands(FileCommands):
    """The commands of a page, each in a process of its own."""

    bench: Bench  #: The job.
    #: What is under way or done, by its name: ``certificate``, ``table``, ``confirmation``, ``experiment``,
    #: ``build``.
    making: Mapping[str, Making]
    _aside: TemporaryDirectory[str] | None = None
    _lock: Lock = field(default_factory=Lock)

    @classmethod
    def of(cls, bench: Bench, plugins: Sequence[Path]) -> Commands:
        """Return the commands of a job."""
        readers = {"certificate": make_documents} | dict.fromkeys(_BY_VALUES, make_values)
        return cls(bench, {name: Making(read, plugins) for name, read in readers.items()})

    def begin(self, name: str, wanted: Wanted) -> dict[str, Any]:
        """Begin to make something, and return how far it is."""
        loaded, path = self.bench.load(), self.bench.path
        file = path.resolve()
        if name == "certificate":
            arguments = [
                str(file),
                *self._make_sheet_job(loaded.job, wanted),
                *list_demanded_formats(wanted, self.bench.registry.renderers),
            ]
        elif name == "table":
            folder = str(loaded.job.directory.resolve())
            arguments = ["compensate", str(file), *self._choose_control(wanted), "--output", folder]
        elif name == "build":
            arguments = ["model", "build", str(file), "--dry-run"]
        elif name == "experiment":
            decide = ",".join(self._choose_effects(wanted))
            arguments = ["plan", str(file), "--decide", decide, "--output", str(file.parent)]
        else:
            _demand(wanted.after, list_siblings(path), "job")
            tests = (str(each.resolve()) for each in (path, path.with_name(wanted.after)))
            arguments = ["compensate", *tests, *self._choose_control(wanted), "--confirm"]
        self.making[name].begin(loaded.stamp, *arguments)
        return self.making[name].describe_state()

    def end(self) -> None:
        """End all that is under way, and take away what was only looked at."""
        FileCommands.end(self)
        with self._lock:
            aside, self._aside = self._aside, None
        if aside is not None:
            aside.cleanup()

    def _make_sheet_job(self, job: Job, wanted: Wanted) -> list[str]:
        """Return the job of the sheet that is looked at before a PDF; none if that is one itself."""
        printed = {each.identifier for each in self.bench.registry.renderers if each.suffix == ".pdf"}
        if job.keys.certificate.layout == "sheet" or printed.isdisjoint(wanted.formats or job.formats):
            return []
        folder = self._make_folder()
        unsigned = {"signature": None} if job.keys.certificate.signature else {}
        keys = {
            "extends": str(self.bench.path.resolve()),
            "certificate": {"layout": "sheet", **unsigned},
            "output": {"directory": folder},
        }
        path = Path(folder, "sheet.yaml")
        write([Document(path, "\n".join(write_group(keys)).encode())])
        return [str(path)]

    def _make_folder(self) -> str:
        """Return the folder of what is only looked at: it is there from the first time on, until the end."""
        with self._lock:
            if self._aside is None:
                self._aside = TemporaryDirectory(prefix="zlmreport-workbench-", ignore_cleanup_errors=True)
            return self._aside.name

    def _choose_effects(self, wanted: Wanted) -> Sequence[str]:
        for each in wanted.effects:
            _demand(each, [effect.identifier for effect in self.bench.registry.effects], "effect")
        return wanted.effects

    def _choose_control(self, wanted: Wanted) -> list[str]:
        _demand(wanted.controller, [each.identifier for each in self.bench.registry.controllers], "control")
        chosen = ["--controller", wanted.controller]
        if wanted.step is not None:
            chosen += ["--step", f"{wanted.step:.10g}"]
        return [*chosen, "--unconfirmed"] if wanted.unconfirmed else chosen


def list_demanded_formats(wanted: Wanted, offered: Iterable[Renderer]) -> list[str]:
    """Return the formats that a page wants as the command line has them; none for those of the file.

    Raises `InputError` if one is none that the page offered.
    """
    known = [renderer.identifier for renderer in offered]
    for each in wanted.formats:
        _demand(each, known, "format")
    return ["--format", ",".join(wanted.formats)] if wanted.formats else []


def list_siblings(path: Path) -> list[str]:
    """Return the names of other jobs in the folder of one: what may be its second test."""
    found = (each.name for each in path.resolve().parent.iterdir() if is_named_as_yaml(each))
    return sorted(name for name in found if name != path.name)[:_MOST]


def list_offered(bench: Bench, loaded: Loaded, language: Language) -> dict[str, Any]:
    """Return what a page offers to have made."""
    job, registry = loaded.job, bench.registry
    chosen = set(job.keys.output.formats)
    return {
        "formats": [
            {"format": each.identifier, "chosen": each.identifier in chosen} for each in registry.renderers
        ],
        "takesTable": job.axis.measurand.is_position,
        "tableIsStated": job.keys.axis.compensation_table is not None,
        "controllers": [
            {
                "controller": each.identifier,
                "title": each.title.in_language(language),
                "isVerified": each.confidence == "verified",
                "chosen": job.controller is not None and job.controller.identifier == each.identifier,
            }
            for each in registry.controllers
        ],
        "unit": job.axis.position_unit.symbol,
        "jobs": list_siblings(bench.path),
    }


def _demand(name: str, known: Sequence[str], what: str) -> None:
    if name not in known:
        raise InputError.at(PLACE, f"there is no {what} {name[:60]!r}")
