"""What a click does to a machine file: an effect comes in or goes out, a step is taken back or done again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

from zlmreport.errors import InputError
from zlmreport.files import demand
from zlmreport.job.parse import LARGEST
from zlmreport.machines.editing import edit_effects, list_effects_with, list_effects_without, put_back
from zlmreport.measurement.units import MICROMETRE
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.web.bench import PLACE
from zlmreport.web.changes import ConflictError, NothingToUndoError, Request
from zlmreport.web.journal import (
    REDO,
    UNDO,
    BenchJournal,
    JournalStep,
    find_redoable,
    find_undoable,
    make_entry,
    record_change,
)
from zlmreport.web.machine_bench import LoadedMachine, MachineBench


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


def _undo(bench: MachineBench, loaded: LoadedMachine, _: Request) -> str:
    return _put_back(loaded, find_undoable(BenchJournal.of(bench.path).read_entries(), loaded.digest))


def _redo(bench: MachineBench, loaded: LoadedMachine, _: Request) -> str:
    return _put_back(loaded, find_redoable(BenchJournal.of(bench.path).read_entries(), loaded.digest))


def _put_back(loaded: LoadedMachine, last: JournalStep | None) -> str:
    if last is None:
        raise NothingToUndoError
    put_back(loaded.machine, last.content)
    return last.subject if last.action in {UNDO, REDO} else f"{last.action} {last.subject}"


def _write_rms(bench: MachineBench, loaded: LoadedMachine) -> float:
    return MICROMETRE.from_si(bench.make_study(loaded).rms)


_ACTIONS: Mapping[str, Callable[[MachineBench, LoadedMachine, Request], str]] = MappingProxyType(
    {"add": _add, "remove": _remove, UNDO: _undo, REDO: _redo}
)
