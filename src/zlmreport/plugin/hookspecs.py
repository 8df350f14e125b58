"""The hooks. Each offers objects and does no work; each is called once, when plugins are found."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pluggy

if TYPE_CHECKING:
    from collections.abc import Iterable

    from zlmreport.model.effect import Effect
    from zlmreport.plugin.protocols import (
        DataSource,
        Instrument,
        PartProgram,
        ProbingProgram,
        Renderer,
        Standard,
    )

PROJECT = "zlmreport"

hookspec = pluggy.HookspecMarker(PROJECT)
#: Marks a plugin's functions that answer these hooks.
hookimpl = pluggy.HookimplMarker(PROJECT)


@hookspec
def zlmreport_standards() -> Iterable[Standard]:  # type: ignore[empty-body]
    """Return the standards that this plugin evaluates by."""


@hookspec
def zlmreport_sources() -> Iterable[DataSource]:  # type: ignore[empty-body]
    """Return the data sources that this plugin reads."""


@hookspec
def zlmreport_renderers() -> Iterable[Renderer]:  # type: ignore[empty-body]
    """Return the file formats that this plugin writes."""


@hookspec
def zlmreport_effects() -> Iterable[Effect]:  # type: ignore[empty-body]
    """Return the effects that this plugin adds to the error model."""


@hookspec
def zlmreport_part_programs() -> Iterable[PartProgram]:  # type: ignore[empty-body]
    """Return the languages in which this plugin writes part programs."""


@hookspec
def zlmreport_instruments() -> Iterable[Instrument]:  # type: ignore[empty-body]
    """Return the live instruments that this plugin reads."""


@hookspec
def zlmreport_probing_programs() -> Iterable[ProbingProgram]:  # type: ignore[empty-body]
    """Return the languages in which this plugin writes probing programs."""
