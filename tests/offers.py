"""Plugins made on the spot, for tests that need to know exactly which there are."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from testing.exemplary_effect import ExemplaryEffect
from testing.exemplary_program import ExemplaryProgram
from zlmreport.plugin import hookimpl
from zlmreport.plugin.registry import Plugin, Registry, collect


def offering(  # noqa: PLR0913, PLR0917 - one for each kind
    standards: Any = (),
    sources: Any = (),
    renderers: Any = (),
    effects: Any = (),
    part_programs: Any = (),
    extensions: Any = (),
) -> SimpleNamespace:
    """Return a plugin that offers these objects."""

    @hookimpl
    def zlmreport_standards() -> Any:
        return standards

    @hookimpl
    def zlmreport_sources() -> Any:
        return sources

    @hookimpl
    def zlmreport_renderers() -> Any:
        return renderers

    @hookimpl
    def zlmreport_effects() -> Any:
        return effects

    @hookimpl
    def zlmreport_part_programs() -> Any:
        return part_programs

    @hookimpl
    def zlmreport_extensions() -> Any:
        return extensions

    return SimpleNamespace(
        zlmreport_standards=zlmreport_standards,
        zlmreport_sources=zlmreport_sources,
        zlmreport_renderers=zlmreport_renderers,
        zlmreport_effects=zlmreport_effects,
        zlmreport_part_programs=zlmreport_part_programs,
        zlmreport_extensions=zlmreport_extensions,
    )


def exemplary_registry() -> Registry:
    """Return a registry of one standard, data source, format, effect and part program."""
    plugin = Plugin("exemplary", "exemplary_module", "exemplary-plugins", "1.2")
    offers = offering(
        [ExemplaryStandard()],
        [ExemplarySource()],
        [ExemplaryRenderer()],
        [ExemplaryEffect()],
        [ExemplaryProgram()],
    )
    return collect([(plugin, offers)])
