"""What the server answers on a whole machine: its tests, steps of its model, document, changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from starlette.requests import Request as HttpRequest
from starlette.responses import Response
from starlette.routing import Route

from zlmreport.errors import InputError
from zlmreport.files import demand
from zlmreport.job.parse import LARGEST
from zlmreport.language import Language
from zlmreport.machines.editing import edit_effects, list_effects_with, list_effects_without, put_back
from zlmreport.measurement.units import MICROMETRE
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.plugin.registry import Registry
from zlmreport.web.answers import PageAnswers
from zlmreport.web.bench import PLACE
from zlmreport.web.changes import ConflictError, Request, find_last_step
from zlmreport.web.commands import FileCommands, Wanted, list_demanded_formats
from zlmreport.web.diagnoses import Diagnoses, DiagnosesByContent
from zlmreport.web.journal import (
    REDO,
    UNDO,
    make_entry,
    record_change,
)
from zlmreport.web.machine_bench import LoadedMachine, MachineBench
from zlmreport.web.machine_tables import TablesWanted, make_tables
from zlmreport.web.machine_view import MachineView
from zlmreport.web.making import Making, make_values
from zlmreport.web.texts import collect_machine_texts

_DIAGNOSING = "zlmreport.web.machine_diagnoses"


@dataclass(frozen=True, slots=True)
class MachineCommands(FileCommands):
    """The document of a machine, made in a process of its own, and its tables, which take no time."""

    bench: MachineBench
    making: Mapping[str, Making]  #: By its name: ``certificate``.
    tables: dict[str, Path] = field(default_factory=dict)  #: Files of tables that were written, by name.

    def begin(self, name: str, wanted: Wanted) -> dict[str, Any]:
        """Begin to make it, and return how far it is."""
        loaded = self.bench.load()
        formats = list_demanded_formats(wanted, self.bench.renderers)
        self.making[name].begin(
            loaded.stamp, "machine", "certificate", str(self.bench.path.resolve()), *formats
        )
        return self.making[name].describe_state()

    def find_file(self, name: str) -> Path | None:
        """Return where a file lies that was made from the page; None for any other name."""
        return self.tables.get(name) or FileCommands.find_file(self, name)


@dataclass(frozen=True, slots=True)
class MachineWorkbench(PageAnswers):
    """The answers for one machine."""

    bench: MachineBench  #: The machine file.
    #: diagnoses and commands: Made beside, each in a process of its own.
    diagnoses: Diagnoses
    commands: MachineCommands

    @classmethod
    def of(cls, path: Path, registry: Registry, plugins: Sequence[Path] = ()) -> MachineWorkbench:
        """Return the answers for a machine.

        Raises `InputError` or `AccessError` as `MachineBench.load`.
        """
        made = cls.on(path, registry, plugins)
        made.bench.load()
        return made

    @classmethod
    def on(cls, path: Path, registry: Registry, plugins: Sequence[Path] = ()) -> MachineWorkbench:
        """Return the answers for a machine, whether or not it can be read: the page says what is wrong."""
        bench = MachineBench(path, registry)
        answers = DiagnosesByContent.of_user(registry.circle_effects)
        commands = MachineCommands(bench, {"certificate": Making(make_values, plugins)})
        return cls(bench, Diagnoses(path, answers, plugins, _DIAGNOSING), commands)

    def list_own_routes(self) -> list[Route]:
        """Return the address of tables across axes."""
        return [Route("/api/tables", self.answer_tables, methods=["POST"])]

    def list_page_texts(self, language: Language) -> dict[str, str]:
        """Return the words of the page, and that it is one of a machine."""
        return collect_machine_texts(language)

    def view(self, language: Language) -> dict[str, Any]:
        """Return the page of the machine."""
        return self._make_view(language).list_page()

    def list_results(self, language: Language) -> dict[str, Any]:
        """Return the fall of the error, the tests in numbers, the 21 errors and the work space."""
        return self._make_view(language).list_results()

    def compare_before_and_after(self, wanted: str, test: str, language: Language) -> dict[str, Any]:
        """Return what the graphs draw before and after a step of the model, or an effect that it may lack."""
        return self._make_view(language).compare_before_and_after(wanted, test)

    def carry_out(self, wanted: Request) -> None:
        """Do what a click asks for."""
        change_machine(self.bench, wanted)

    async def answer_tables(self, request: HttpRequest) -> Response:
        """Answer with the forecast of tables across axes, write them, or hold circles against them."""

        def make(wanted: TablesWanted) -> dict[str, Any]:
            view = self._make_view(self.choose_language(request))
            values, documents = make_tables(self.bench, view.loaded, wanted, view.names)
            self.commands.tables.update({each.path.name: each.path for each in documents})
            return values

        return await self.answer_wanted(request, TablesWanted, make)

    def _make_view(self, language: Language) -> MachineView:
        return MachineView(self.bench, self.bench.load(), language)


def change_machine(bench: MachineBench, request: Request) -> None:
    """Do what a click asks for.

    Raises `ConflictError` if the file is no longer the one that the page showed; `NothingToUndoError` if
    there is nothing to take back; `InputError` or `AccessError` if the change makes no sense, or the file
    cannot be written.
    """
    with bench.lock:
        loaded = bench.load()
        if request.based_on != loaded.digest:
            raise ConflictError
        if request.action not in _ACTIONS:
            raise InputError.at(PLACE, f"a machine has no action {request.action[:60]!r}")
        before, content = _write_rms(bench, loaded), demand(bench.path, LARGEST)
        subject = _ACTIONS[request.action](bench, loaded, request)
        after = _write_rms(bench, bench.load())
        changed = content, demand(bench.path, LARGEST)
        record_change(bench.path, make_entry(request.action, subject, changed, (before, after)))


def _add(bench: MachineBench, loaded: LoadedMachine, request: Request) -> str:
    return _write(
        bench, loaded, request, list_effects_with(loaded.machine, request.effect, bench.registry, PLACE)
    )


def _remove(bench: MachineBench, loaded: LoadedMachine, request: Request) -> str:
    return _write(bench, loaded, request, list_effects_without(loaded.machine, request.effect))


def _write(
    bench: MachineBench, loaded: LoadedMachine, request: Request, effects: Sequence[CircleEffect]
) -> str:
    """Write a list of effects once a study with them has been made, and return what was changed."""
    bench.make_study(loaded, effects)
    edit_effects(loaded.machine, tuple(each.identifier for each in effects))
    return request.effect


def _put_back(bench: MachineBench, loaded: LoadedMachine, request: Request) -> str:
    content, subject = find_last_step(bench.path, loaded.digest, request)
    put_back(loaded.machine, content)
    return subject


def _write_rms(bench: MachineBench, loaded: LoadedMachine) -> float:
    return MICROMETRE.from_si(bench.make_study(loaded).rms)


_ACTIONS: Mapping[str, Callable[[MachineBench, LoadedMachine, Request], str]] = {
    "add": _add,
    "remove": _remove,
    UNDO: _put_back,
    REDO: _put_back,
}
