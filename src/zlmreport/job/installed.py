"""What a job needs to know of the plugins that it names; `zlmreport.plugins.Registry` answers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

from zlmreport.errors import Place
from zlmreport.job.types import Options


class Named(Protocol):
    """A plugin, by what jobs call it."""

    @property
    def identifier(self) -> str:
        """As jobs name it."""


class WithKeys(Named, Protocol):
    """A plugin with keys of its own: a data source, a live instrument."""

    @property
    def options(self) -> type[Options]:
        """Its own keys."""


class LimitedQuantity(Protocol):
    """A parameter for which a job may state a tolerance."""

    @property
    def symbol(self) -> str:
        """As jobs and results name it."""

    @property
    def can_be_limited(self) -> bool:
        """Whether a tolerance makes sense for it."""


class InstalledStandard(WithKeys, Protocol):
    """A standard, and the parameters that a job may limit."""

    @property
    def quantities(self) -> Sequence[LimitedQuantity]:
        """Its parameters."""


class InstalledRenderer(Named, Protocol):
    """A file format."""

    @property
    def suffix(self) -> str:
        """Of its files."""


class InstalledProgram(WithKeys, Protocol):
    """A writer of part programs or probing programs."""

    @property
    def suffix(self) -> str:
        """Of its files."""


class NamedParameter(Protocol):
    """A parameter of an effect."""

    @property
    def name(self) -> str:
        """As jobs name it."""


class InstalledEffect(WithKeys, Protocol):
    """An effect, and the parameters that a job may give."""

    @property
    def linear(self) -> Sequence[NamedParameter]:
        """Parameters that are solved for."""

    @property
    def searched(self) -> Sequence[NamedParameter]:
        """Parameters that are searched."""

    def with_settings(self, settings: Any) -> InstalledEffect:
        """Return the form of it that its own keys ask for."""


class Installed(Protocol):
    """All plugins, by what jobs call them.

    The lookups raise `InputError` at `named_at` for an identifier that no plugin provides.
    """

    @property
    def sources(self) -> Sequence[WithKeys]:
        """All data sources."""

    @property
    def standards(self) -> Sequence[InstalledStandard]:
        """All standards."""

    @property
    def renderers(self) -> Sequence[InstalledRenderer]:
        """All file formats."""

    @property
    def effects(self) -> Sequence[InstalledEffect]:
        """All effects."""

    @property
    def part_programs(self) -> Sequence[InstalledProgram]:
        """All writers of part programs."""

    @property
    def probing_programs(self) -> Sequence[InstalledProgram]:
        """All writers of probing programs."""

    @property
    def instruments(self) -> Sequence[WithKeys]:
        """All live instruments."""

    def source(self, identifier: str, named_at: Place | None = None) -> WithKeys:
        """Return a data source."""

    def standard(self, identifier: str, named_at: Place | None = None) -> InstalledStandard:
        """Return a standard."""

    def renderer(self, identifier: str, named_at: Place | None = None) -> InstalledRenderer:
        """Return a file format."""

    def effect(self, identifier: str, named_at: Place | None = None) -> InstalledEffect:
        """Return an effect."""

    def part_program(self, identifier: str, named_at: Place | None = None) -> InstalledProgram:
        """Return a writer of part programs."""

    def probing_program(self, identifier: str, named_at: Place | None = None) -> InstalledProgram:
        """Return a writer of probing programs."""

    def instrument(self, identifier: str, named_at: Place | None = None) -> WithKeys:
        """Return a live instrument."""
