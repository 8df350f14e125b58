"""The installed plugins by kind and name; messages where one is missing, or provided twice."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Self, TypeVar

from zlmreport.errors import InputError, Place, Problem, ZlmreportError, did_you_mean
from zlmreport.language import Words
from zlmreport.plugin import kinds
from zlmreport.plugin.boundary import Guarded
from zlmreport.plugin.kinds import KINDS, Kind
from zlmreport.plugin.registry.candidate import DISABLE, FailedPlugin, Plugin, PluginCandidate

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.model.effects.circle_effect import CircleEffect
    from zlmreport.model.effects.effect import Effect
    from zlmreport.plugin.extending import Extension
    from zlmreport.plugin.protocols import (
        Controller,
        DataSource,
        Instrument,
        PartProgram,
        Renderer,
        Standard,
    )


_WHY = Words("two plugins provide it")


class _Doubtful(Guarded):
    """An effect of which nobody knows which is meant."""

    def untestable(self, _design: object) -> Words:
        """Return why no test of it is made."""
        return _WHY

    def forms(self) -> tuple[Self, ...]:
        """Return itself: no form of it is tried."""
        return (self,)


Wanted = TypeVar("Wanted")


@dataclass(frozen=True, slots=True)
class Offer:
    """What a plugin offers."""

    #: kind and identifier: What it is, and what jobs call it.
    kind: Kind[Any]
    identifier: str
    offered: Any  #: The object.
    plugin: Plugin  #: Where it comes from.


class Registry:
    """The plugins there are, by kind and name.

    `candidates`: All of them. One of which nobody knows what it offers is loaded at once, any other when it
        is needed.

    Raises `InputError` if a plugin has a misspelt hook: what it offers would be missing in silence. So does
    everything that loads one.
    """

    def __init__(self, candidates: Iterable[PluginCandidate] = (), disabled: Iterable[str] = ()) -> None:
        self.disabled = tuple(disabled)
        self.refused: ZlmreportError | None = None
        self._candidates = sorted(candidates, key=lambda each: (each.plugin.name, each.plugin.module))

    def find(self, kind: Kind[Wanted], identifier: str, named_at: Place | None = None) -> Wanted:
        """Return what jobs call by this name.

        Raises `InputError` at the place that names it, if there is none, or more than one.
        """
        key, place = (kind.name, identifier), named_at or Place("zlmreport")
        for candidate in self._find_one(key, place):
            offered = self._load(candidate)
            if key in offered:
                found: Wanted = offered[key]
                return found
        raise self._make_absence(kind, identifier, self.list_identifiers(kind), place)

    def _make_absence(
        self, kind: Kind[Any], identifier: str, known: Sequence[str], named_at: Place | None
    ) -> InputError:
        """Return the error that there is nothing of this name, with the nearest and what does not work."""
        lines = [f"no plugin provides {kind.label} {identifier[:60]!r}; {did_you_mean(identifier, known)}"]
        lines.extend(f"plugin {each.plugin.name} was not loaded: {each.reason}" for each in self.failed)
        lines.extend(f"plugin {name} is switched off by {DISABLE}" for name in self.disabled)
        return InputError([Problem(named_at or Place("zlmreport"), "\n  ".join(lines))])

    def list_all(self, kind: Kind[Wanted]) -> tuple[Wanted, ...]:
        """Return everything of one kind, in the order of identifiers.

        What two plugins provide is left out: only who names it is stopped. An effect stands here all the
        same, as one that cannot be tested, so that no diagnosis lacks it in silence.
        """
        found: list[Wanted] = []
        for identifier in self.list_identifiers(kind):
            key = kind.name, identifier
            offering = self._list_offering(key)
            offered = [each[key] for each in map(self._load, offering) if key in each]
            if len(offering) == 1:
                found.extend(offered)
            elif kind is kinds.EFFECT and offered:
                found.append(offered[0].guard_as(_Doubtful))
        return tuple(found)

    def list_identifiers(self, kind: Kind[Any]) -> tuple[str, ...]:
        """Return what jobs call what there is of one kind, in order; only plugins that say so are loaded."""
        return tuple(
            sorted({key[1] for each in self._candidates for key in each.keys if key[0] == kind.name})
        )

    def find_origin(self, kind: Kind[Any], identifier: str) -> Plugin:
        """Return the plugin that offers this."""
        (candidate,) = self._find_one((kind.name, identifier), Place("zlmreport"))
        return candidate.plugin

    def list_offers(self) -> tuple[Offer, ...]:
        """Return everything, in the order of kinds and identifiers: all plugins are loaded."""
        return tuple(
            Offer(kind, identifier, offered, candidate.plugin)
            for kind in KINDS
            for name, identifier, offered, candidate in sorted(
                (
                    (*key, offered, candidate)
                    for candidate in self._candidates
                    for key, offered in candidate.offered.items()
                ),
                key=lambda each: each[:2],
            )
            if name == kind.name
        )

    def list_clashes(self) -> tuple[str, ...]:
        """Return a sentence on each name that two plugins provide: no job can use it."""
        return tuple(
            _say_provided_twice(kind, identifier, offering)
            for kind in KINDS
            for identifier in self.list_identifiers(kind)
            if len(offering := self._list_offering((kind.name, identifier))) > 1
        )

    @property
    def failed(self) -> tuple[FailedPlugin, ...]:
        """Plugins that were to be loaded and could not be."""
        return tuple(each.failure for each in self._candidates if each.failure)

    @property
    def misspelt(self) -> tuple[Problem, ...]:
        """Functions of loaded plugins that look like hooks and are none."""
        return tuple(problem for each in self._candidates for problem in each.misspelt)

    def list_versions(self, job: Job) -> dict[str, str]:
        """Return the release of every plugin that a job's results come from, by its identifier."""
        used: list[tuple[Kind[Any], str]] = [(kinds.SOURCE, each.identifier) for each in job.sources]
        used.extend((kinds.STANDARD, each.identifier) for part in job.parts for each in part.standards)
        effects = (each for part in job.parts for each in part.effects)
        used.extend((kinds.EFFECT, each.installed) for each in effects if not each.is_formula)
        return {identifier: self.find_origin(kind, identifier).release for kind, identifier in used}

    def _load(self, candidate: PluginCandidate) -> Any:
        offered = candidate.offered
        if candidate.misspelt:
            raise InputError(candidate.misspelt)
        return offered

    def _find_one(self, key: tuple[str, str], place: Place) -> Sequence[PluginCandidate]:
        """Return the plugin that offers this, if there is one; two would answer differently."""
        offering = self._list_offering(key)
        if len(offering) > 1:
            kind = next(kind for kind in KINDS if kind.name == key[0])
            raise InputError.at(place, _say_provided_twice(kind, key[1], offering))
        return offering

    def _list_offering(self, key: tuple[str, str]) -> Sequence[PluginCandidate]:
        return [each for each in self._candidates if key in each.keys]

    @property
    def standards(self) -> tuple[Standard, ...]:
        """All standards."""
        return self.list_all(kinds.STANDARD)

    @property
    def sources(self) -> tuple[DataSource, ...]:
        """All data sources."""
        return self.list_all(kinds.SOURCE)

    @property
    def renderers(self) -> tuple[Renderer, ...]:
        """All file formats."""
        return self.list_all(kinds.RENDERER)

    @property
    def effects(self) -> tuple[Effect, ...]:
        """All effects."""
        return self.list_all(kinds.EFFECT)

    @property
    def circle_effects(self) -> tuple[CircleEffect, ...]:
        """All effects of circles."""
        return self.list_all(kinds.CIRCLE_EFFECT)

    @property
    def controllers(self) -> tuple[Controller, ...]:
        """All controls for which compensation tables are written."""
        return self.list_all(kinds.CONTROLLER)

    @property
    def extensions(self) -> tuple[Extension, ...]:
        """All groups of job keys that plugins add."""
        return self.list_all(kinds.EXTENSION)

    @property
    def extension_keys(self) -> tuple[str, ...]:
        """The keys of these groups; only plugins that say so are loaded."""
        return self.list_identifiers(kinds.EXTENSION)

    @property
    def axis_keys(self) -> tuple[str, ...]:
        """Those of them that stand for the axis of a job."""
        return tuple(each.identifier for each in self.extensions if each.stands_for_axis)

    @property
    def instruments(self) -> tuple[Instrument, ...]:
        """All live instruments."""
        return self.list_all(kinds.INSTRUMENT)

    def standard(self, identifier: str, named_at: Place | None = None) -> Standard:
        """Return a standard, as `find` does; by the name of an identical adoption, too."""
        if identifier not in self.list_identifiers(kinds.STANDARD):
            from zlmreport.job.standards import list_adoptions_of  # noqa: PLC0415 - a listing of names needs no jobs

            for each in self.standards:
                if identifier in list_adoptions_of(each):
                    return each
        return self.find(kinds.STANDARD, identifier, named_at)

    def source(self, identifier: str, named_at: Place | None = None) -> DataSource:
        """Return a data source, as `find` does."""
        return self.find(kinds.SOURCE, identifier, named_at)

    def renderer(self, identifier: str, named_at: Place | None = None) -> Renderer:
        """Return a renderer, as `find` does."""
        return self.find(kinds.RENDERER, identifier, named_at)

    def effect(self, identifier: str, named_at: Place | None = None) -> Effect:
        """Return an effect, as `find` does; ``scale-joint-2`` is the second of those that may be several."""
        from zlmreport.job.effect_choices import part_number  # noqa: PLC0415 - a listing of names needs no jobs

        name, number = part_number(identifier)
        if number > 1 and name in self.list_identifiers(kinds.EFFECT):
            first = self.find(kinds.EFFECT, name, named_at)
            if first.several:
                return first.repeated(number)
        return self.find(kinds.EFFECT, identifier, named_at)

    def circle_effect(self, identifier: str, named_at: Place | None = None) -> CircleEffect:
        """Return an effect of circles, as `find` does."""
        return self.find(kinds.CIRCLE_EFFECT, identifier, named_at)

    def part_program(
        self, identifier: str, named_at: Place | None = None, takes: type | None = None
    ) -> PartProgram:
        """Return a writer of part programs, as `find` does, among those that `list_programs_for` returns."""
        if identifier in self.list_identifiers(kinds.PART_PROGRAM):
            program = self.find(kinds.PART_PROGRAM, identifier, named_at)
            if _is_for(program, takes):
                return program
        known = [each.identifier for each in self.list_programs_for(takes)]
        raise self._make_absence(kinds.PART_PROGRAM, identifier, known, named_at)

    def list_programs_for(self, takes: type | None = None) -> tuple[PartProgram, ...]:
        """Return the part programs that are written of this; without it, of the motion of a planned test."""
        return tuple(each for each in self.list_all(kinds.PART_PROGRAM) if _is_for(each, takes))

    def controller(self, identifier: str, named_at: Place | None = None) -> Controller:
        """Return a control for which compensation tables are written, as `find` does."""
        return self.find(kinds.CONTROLLER, identifier, named_at)

    def extension(self, identifier: str, named_at: Place | None = None) -> Extension:
        """Return a group of job keys that a plugin adds, as `find` does."""
        return self.find(kinds.EXTENSION, identifier, named_at)

    def instrument(self, identifier: str, named_at: Place | None = None) -> Instrument:
        """Return a live instrument, as `find` does."""
        return self.find(kinds.INSTRUMENT, identifier, named_at)


def _is_for(program: PartProgram, takes: type | None) -> bool:
    """Return whether a part program is written of this, or without it of the motion of a planned test."""
    from zlmreport.model.planning.programs import Motion  # noqa: PLC0415 (only who asks for programs loads them)
    from zlmreport.plugin.protocols import find_taken_by  # noqa: PLC0415

    return find_taken_by(program) is (takes or Motion)


def _say_provided_twice(kind: Kind[Any], identifier: str, offering: Sequence[PluginCandidate]) -> str:
    """Return the sentence on what two plugins provide."""
    first, second = (each.plugin for each in offering[:2])
    way_out = f"switch one off: {DISABLE}={second.name}"
    if first.name == second.name:  # of entry points that name the same object: the name switches both off
        way_out = f"uninstall {' or '.join(each.distribution or each.module for each in (first, second))}"
    return (
        f"two plugins provide {kind.label} {identifier!r}: {first.module or first.name} and "
        f"{second.module or second.name}; {way_out}"
    )


def _take_as_it_is(module: object) -> object:
    return module


def collect(loaded: Iterable[tuple[Plugin, object]], disabled: Iterable[str] = ()) -> Registry:
    """Return the registry of modules, or of any objects that have hooks; raise `InputError` as it does."""
    candidates = [PluginCandidate(plugin, partial(_take_as_it_is, module)) for plugin, module in loaded]
    registry = Registry(candidates, disabled)
    registry.list_offers()
    if registry.misspelt:
        raise InputError(registry.misspelt)
    return registry
