"""The hooks: what a plugin is asked, a function for each kind.

A plugin answers those that concern it, each with a list; `zlmreport.plugin.kinds` says what must be in it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import pluggy

if TYPE_CHECKING:
    from zlmreport.model.effects.circle_effect import CircleEffect
    from zlmreport.model.effects.effect import Effect
    from zlmreport.plugin.extending import Extension
    from zlmreport.plugin.protocols import (
        Controller,
        DataSource,
        Instrument,
        Notifier,
        PartProgram,
        Renderer,
        Standard,
    )

PROJECT = "zlmreport"

#: Marks a plugin's functions that answer hooks.
hookimpl = pluggy.HookimplMarker(PROJECT)
hookspec = pluggy.HookspecMarker(PROJECT)


@hookspec
def zlmreport_standards() -> Iterable[Standard]:
    """Return the standards that this plugin evaluates by."""
    raise NotImplementedError


@hookspec
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the data sources that this plugin reads."""
    raise NotImplementedError


@hookspec
def zlmreport_renderers() -> Iterable[Renderer]:
    """Return the file formats that this plugin writes."""
    raise NotImplementedError


@hookspec
def zlmreport_effects() -> Iterable[Effect]:
    """Return the effects that this plugin adds to the error model."""
    raise NotImplementedError


@hookspec
def zlmreport_circle_effects() -> Iterable[CircleEffect]:
    """Return the effects of drives and structure that this plugin adds to the model of a machine."""
    raise NotImplementedError


@hookspec
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the languages in which this plugin writes part programs."""
    raise NotImplementedError


@hookspec
def zlmreport_controllers() -> Iterable[Controller]:
    """Return the controls for which this plugin writes compensation tables."""
    raise NotImplementedError


@hookspec
def zlmreport_extensions() -> Iterable[Extension]:
    """Return the groups of job keys that this plugin adds, with all that a job gets by them."""
    raise NotImplementedError


@hookspec
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the live instruments that this plugin reads."""
    raise NotImplementedError


@hookspec
def zlmreport_notifiers() -> Iterable[Notifier]:
    """Return the ways in which this plugin tells people what a fleet came to."""
    raise NotImplementedError
