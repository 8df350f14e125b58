"""Protocols: what a job needs to know of installed plugins, as the registry answers it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Protocol

from zlmreport.errors import Place
from zlmreport.job.extends import FileFormat
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Step
from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.measurement.units import Unit


class Named(Protocol):
    """A plugin, by what jobs call it: a file format."""

    identifier: str  #: As jobs name it.


class WithKeys(Named, Protocol):
    """A plugin with keys of its own: a data source, a control, a live instrument."""

    options: type[Options]  #: Its own keys.


class LimitedQuantity(Protocol):
    """A parameter for which a job may state a tolerance."""

    @property
    def symbol(self) -> str:
        """As jobs and results name it."""

    @property
    def notation(self) -> str:
        """As the standard prints it (`zlmreport.language.formatting`)."""

    @property
    def name(self) -> Words:
        """In the wording of the standard."""

    @property
    def can_be_limited(self) -> bool:
        """Whether a tolerance makes sense for it."""

    @property
    def unit(self) -> Unit | None:
        """Its own unit; None for that of what was measured."""


class InstalledStandard(WithKeys, Protocol):
    """A standard, and the parameters that a job may limit."""

    @property
    def quantities(self) -> Sequence[LimitedQuantity]:
        """Its parameters."""


def list_adoptions_of(standard: InstalledStandard) -> tuple[str, ...]:
    """Return the names under which other bodies publish a standard's text; none for most."""
    return getattr(standard, "adoptions", ())


class InstalledProgram(WithKeys, Protocol):
    """A writer of part programs."""

    suffix: str  #: Of its files.


class InstalledExtension(WithKeys, Protocol):
    """A group of job keys called as it is, where in it part programs are listed, what it says of a job."""

    description: str  #: What it is.
    example: Mapping[str, Any]  #: Some of its keys.
    programs: tuple[str, ...]  #: The path to its part programs; empty for none.
    takes: type | None  #: What they are written of.
    formats: tuple[FileFormat, ...]  #: Files with a key `schema` that its keys name.

    def contradictions(self, keys: JobKeys, options: Any) -> Iterable[tuple[tuple[Step, ...], str]]:
        """Yield what no single key of a job shows to be wrong."""

    def completed(self, keys: JobKeys, options: Any) -> JobKeys:
        """Return the keys of a job with what the group says of them."""


class NamedParameter(Protocol):
    """A parameter of an effect."""

    @property
    def name(self) -> str:
        """As jobs name it."""

    @property
    def description(self) -> Words:
        """In words."""


class InstalledEffect(WithKeys, Protocol):
    """An effect, and the parameters that a job may give."""

    title: Words  #: In words.
    several: bool  #: Whether it may stand in a model more than once.

    @property
    def linear(self) -> Sequence[NamedParameter]:
        """Parameters that are solved for."""

    @property
    def searched(self) -> Sequence[NamedParameter]:
        """Parameters that are searched."""

    def with_settings(self, settings: Any) -> InstalledEffect:
        """Return the form of it that its own keys ask for."""


class Installed(Protocol):
    """All plugins, by kind, and by what jobs call them.

    The lookups raise `InputError` at `named_at` for an identifier that no plugin provides.
    """

    @property
    def sources(self) -> Sequence[WithKeys]: ...
    @property
    def standards(self) -> Sequence[InstalledStandard]: ...
    @property
    def renderers(self) -> Sequence[Named]: ...
    @property
    def effects(self) -> Sequence[InstalledEffect]: ...
    @property
    def controllers(self) -> Sequence[WithKeys]: ...
    @property
    def instruments(self) -> Sequence[WithKeys]: ...
    @property
    def extensions(self) -> Sequence[InstalledExtension]: ...
    @property
    def extension_keys(self) -> Sequence[str]:
        """The keys of the groups that plugins add."""

    @property
    def axis_keys(self) -> Sequence[str]:
        """Those that stand for the axis of a job."""

    def source(self, identifier: str, named_at: Place | None = None) -> WithKeys: ...
    def standard(self, identifier: str, named_at: Place | None = None) -> InstalledStandard: ...
    def renderer(self, identifier: str, named_at: Place | None = None) -> Named: ...
    def effect(self, identifier: str, named_at: Place | None = None) -> InstalledEffect: ...
    def list_programs_for(self, takes: type | None = None) -> Sequence[InstalledProgram]:
        """Return the writers of part programs that take this; without it, the motion of a planned test."""

    def controller(self, identifier: str, named_at: Place | None = None) -> WithKeys: ...
    def part_program(
        self, identifier: str, named_at: Place | None = None, takes: type | None = None
    ) -> InstalledProgram:
        """Return a writer of part programs that takes this; without it, the motion of a planned test."""

    def extension(self, identifier: str, named_at: Place | None = None) -> InstalledExtension: ...
    def instrument(self, identifier: str, named_at: Place | None = None) -> WithKeys: ...
