"""The plugins there are, by kind and name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeVar

from zlmreport.errors import InputError, Place, did_you_mean
from zlmreport.job.job import Job
from zlmreport.model.effect import Effect
from zlmreport.plugin.protocols import (
    DataSource,
    Instrument,
    PartProgram,
    ProbingProgram,
    Renderer,
    Standard,
)
from zlmreport.plugins.kind import Kind
from zlmreport.plugins.origin import FailedPlugin, Plugin

#: Environment variable that switches plugins off.
DISABLE = "ZLMREPORT_DISABLE_PLUGINS"

Offered = TypeVar("Offered", Standard, DataSource, Renderer, Effect, PartProgram, Instrument, ProbingProgram)


@dataclass(frozen=True, slots=True)
class Registry:
    """The plugins there are.

    Attributes
    ----------
    standards, sources, renderers, effects, part_programs, instruments, probing_programs
        What they offer, in the order of identifiers.
    origins
        The plugin that offers each, by kind and identifier.
    failed
        Plugins that could not be loaded.
    disabled
        Names of plugins that the environment switches off.
    """

    standards: tuple[Standard, ...] = ()
    sources: tuple[DataSource, ...] = ()
    renderers: tuple[Renderer, ...] = ()
    effects: tuple[Effect, ...] = ()
    origins: Mapping[tuple[Kind, str], Plugin] = field(default_factory=lambda: MappingProxyType({}))
    failed: tuple[FailedPlugin, ...] = ()
    disabled: tuple[str, ...] = ()
    part_programs: tuple[PartProgram, ...] = ()
    instruments: tuple[Instrument, ...] = ()
    probing_programs: tuple[ProbingProgram, ...] = ()

    def standard(self, identifier: str, named_at: Place | None = None) -> Standard:
        """Return a standard; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.STANDARD, self.standards, identifier, named_at)

    def source(self, identifier: str, named_at: Place | None = None) -> DataSource:
        """Return a data source; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.SOURCE, self.sources, identifier, named_at)

    def renderer(self, identifier: str, named_at: Place | None = None) -> Renderer:
        """Return a renderer; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.RENDERER, self.renderers, identifier, named_at)

    def effect(self, identifier: str, named_at: Place | None = None) -> Effect:
        """Return an effect; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.EFFECT, self.effects, identifier, named_at)

    def part_program(self, identifier: str, named_at: Place | None = None) -> PartProgram:
        """Return a part program; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.PART_PROGRAM, self.part_programs, identifier, named_at)

    def instrument(self, identifier: str, named_at: Place | None = None) -> Instrument:
        """Return a live instrument; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.INSTRUMENT, self.instruments, identifier, named_at)

    def probing_program(self, identifier: str, named_at: Place | None = None) -> ProbingProgram:
        """Return a probing program; raise `InputError` at the place that names it if there is none."""
        return self._find(Kind.PROBING_PROGRAM, self.probing_programs, identifier, named_at)

    def versions(self, job: Job) -> dict[str, str]:
        """Return the release of every plugin that a job's results come from, by its identifier."""
        used = [(Kind.SOURCE, each.identifier) for each in (job.source, job.source_as_found) if each]
        used.extend((Kind.STANDARD, choice.identifier) for choice in job.standards)
        used.extend((Kind.EFFECT, choice.identifier) for choice in job.effects)
        return {key[1]: self.origins[key].release for key in used}

    def _find(
        self, kind: Kind, offered: tuple[Offered, ...], identifier: str, named_at: Place | None
    ) -> Offered:
        for each in offered:
            if each.identifier == identifier:
                return each
        known = [each.identifier for each in offered]
        lines = [f"no plugin provides {kind.label} {identifier[:60]!r}; {did_you_mean(identifier, known)}"]
        lines.extend(f"plugin {each.plugin.name} was not loaded: {each.reason}" for each in self.failed)
        lines.extend(f"plugin {name} is switched off by {DISABLE}" for name in self.disabled)
        raise InputError.at(named_at or Place("zlmreport"), "\n  ".join(lines))
