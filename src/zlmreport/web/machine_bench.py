"""A machine file on the bench: read again whenever a file behind it changes, its models studied once each."""

from __future__ import annotations

import hashlib
from collections import OrderedDict
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from zlmreport.language import Language
from zlmreport.machines.reading import MachineFile, read_machine
from zlmreport.machines.study import CircleStudy
from zlmreport.model.effects.circle_effect import CircleEffect
from zlmreport.plugin.protocols import Renderer, needs_job
from zlmreport.verification.carrier import find_results_in
from zlmreport.web.watched import WatchedFile

#: Studies that are kept: more than anybody tries in an hour.
_KEPT = 32


@dataclass(frozen=True, slots=True)
class LoadedMachine:
    """A machine file as it stands, with all that it names."""

    machine: MachineFile
    stamp: str  #: Names the state of all files behind it.

    @property
    def digest(self) -> str:
        """SHA-256 of the machine file: what a change says that it was made from."""
        return self.machine.file.file.sha256

    @property
    def language(self) -> Language:
        """Of its document."""
        return self.machine.file.keys.certificate.language

    @property
    def content(self) -> str:
        """Names what stands in all files behind it, wherever and whenever they were written."""
        return hashlib.sha256(" ".join(each.sha256 for each in self.machine.sources).encode()).hexdigest()

    @property
    def basis(self) -> str:
        """Names what its circles and predictions follow from: all but the model."""
        machine = self.machine
        keys = machine.file.keys.model_copy(update={"model": None})
        others = (each.sha256 for each in machine.sources if each is not machine.file.file)
        return hashlib.sha256(f"{keys!r} {' '.join(others)}".encode()).hexdigest()


@dataclass(slots=True)
class MachineBench(WatchedFile[LoadedMachine]):
    """A machine file that is worked on."""

    _studies: OrderedDict[tuple[str, ...], CircleStudy] = field(default_factory=OrderedDict)

    @property
    def renderers(self) -> list[Renderer]:
        """Those that make a document on a machine."""
        return [each for each in self.registry.renderers if not needs_job(each)]

    def read(self) -> tuple[Callable[[str], LoadedMachine], Iterable[Path | None]]:
        """Read the machine with all its tests."""
        machine = read_machine(self.path, self.registry, find_results_in)
        return partial(LoadedMachine, machine), (each.path for each in machine.sources)

    def make_study(self, loaded: LoadedMachine, effects: Iterable[CircleEffect] | None = None) -> CircleStudy:
        """Return the study of the circles with the effects of the model, or with others: each made once.

        Raises `InputError` if the file names no circle.
        """
        chosen = loaded.machine.effects if effects is None else tuple(effects)
        key = (loaded.basis, *(each.identifier for each in chosen))
        with self.lock:
            if key not in self._studies:
                self._studies[key] = loaded.machine.make_study(chosen)
                if len(self._studies) > _KEPT:
                    self._studies.popitem(last=False)
            self._studies.move_to_end(key)
            return self._studies[key]


@dataclass(frozen=True, slots=True)
class FallenError:
    """How far the error has fallen with an effect."""

    effect: str  #: Empty of the first two: nothing is taken away, and what the axes predict is.
    rms: float  #: Of all circles together, m.


def find_fall_of(bench: MachineBench, loaded: LoadedMachine) -> tuple[FallenError, ...]:
    """Return the error of the circles as measured, beside the axes, and after each effect of the model.

    Where the bar stands and how long it is belongs to no error: such effects are there from the beginning.
    """
    base = tuple(each for each in loaded.machine.effects if each.is_base)
    further = tuple(each for each in loaded.machine.effects if not each.is_base)
    by_axes = bench.make_study(loaded, base)
    measured = replace(by_axes, deviation=by_axes.deviation + by_axes.predicted)
    return (
        FallenError("", measured.rms),
        FallenError("", by_axes.rms),
        *(
            FallenError(each.identifier, bench.make_study(loaded, (*base, *further[: number + 1])).rms)
            for number, each in enumerate(further)
        ),
    )
