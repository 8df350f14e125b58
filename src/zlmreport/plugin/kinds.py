"""The kinds of plugins, each declared once: its hook, its interface, its keys, its kit.

All else follows from a row of this table: the hook that plugins answer, what is asked of an object before it
is used, the listing of ``zlmreport plugins``, the reference page and its kit.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, Generic, TypeVar, cast

from zlmreport import plugin as doors
from zlmreport.plugin import hooks

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

Offered_co = TypeVar("Offered_co", covariant=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind(Generic[Offered_co]):
    """What a plugin may offer."""

    name: str  #: In hooks, and where a distribution declares what it offers.
    offers: str  #: What its hook returns.
    label: str  #: In messages and listings.
    door: str  #: The module of `zlmreport.plugin` that its authors import.
    interface: str  #: The name there of what each must be.
    reserved: frozenset[str] = frozenset()  #: Job keys that it must not have of its own.
    suffix: str = ""  #: Such as its files have; empty for what writes no file.
    has_keys: bool = True  #: Whether a job can give it keys of its own.
    #: Returns what is wrong with one beyond a missing member; empty if nothing is.
    lacks: Callable[[Any], str] = lambda _: ""

    @property
    def hook(self) -> str:
        """The function that a plugin answers: ``zlmreport_standards``."""
        return f"{hooks.PROJECT}_{self.name}s"

    @property
    def group(self) -> str:
        """The group of entry points that name objects of this kind: ``zlmreport.standard``."""
        return f"{hooks.PROJECT}.{self.name}"

    @property
    def protocol(self) -> type[Offered_co]:
        """What each must be."""
        return cast(
            "type[Offered_co]", getattr(import_module(f"{doors.__name__}.{self.door}"), self.interface)
        )

    @property
    def members(self) -> tuple[str, ...]:
        """What each must have."""
        public = (name for name in (*self.protocol.__annotations__, *vars(self.protocol)) if name[0] != "_")
        return tuple(dict.fromkeys(public))

    def __str__(self) -> str:
        return self.name


#: How sure it is that a control reads a table as it was written.
_CONFIDENCES = ("verified", "documented", "unconfirmed")


def _say_meaning_two_things(effect: Any) -> str:
    """Tell of a job key of an effect that means two things, names of parameters among them."""
    from zlmreport.job.types import list_keys_in  # noqa: PLC0415 - brings pydantic

    names = [parameter.name for parameter in (*effect.linear, *effect.searched)]
    names.extend(list_keys_in(effect.options))
    twice = sorted(name for name, times in Counter(names).items() if times > 1)
    return f"has two parameters or keys called {twice[0]!r}" if twice else ""


def _say_unknown_confidence(controller: Any) -> str:
    """Tell of a confidence that nobody could print."""
    if controller.confidence in _CONFIDENCES:
        return ""
    known = " or ".join((", ".join(_CONFIDENCES[:-1]), _CONFIDENCES[-1]))
    return f"needs a confidence of {known}, not {controller.confidence!r}"


STANDARD: Kind[Standard] = Kind(
    name="standard",
    offers="the standards that this plugin evaluates by",
    label="standard",
    door="standard",
    interface="Standard",
    reserved=frozenset({"standard", "tolerances"}),
)
SOURCE: Kind[DataSource] = Kind(
    name="source",
    offers="the data sources that this plugin reads",
    label="data source",
    door="source",
    interface="DataSource",
    reserved=frozenset({"plugin"}),
)
RENDERER: Kind[Renderer] = Kind(
    name="renderer",
    offers="the file formats that this plugin writes",
    label="format",
    door="renderer",
    interface="Renderer",
    suffix=".pdf",
    has_keys=False,
)
EFFECT: Kind[Effect] = Kind(
    name="effect",
    offers="the effects that this plugin adds to the error model",
    label="effect",
    door="effect",
    interface="Effect",
    lacks=_say_meaning_two_things,
)
CIRCLE_EFFECT: Kind[CircleEffect] = Kind(
    name="circle_effect",
    offers="the effects of drives and structure that this plugin adds to the model of a machine",
    label="circle effect",
    door="circle_effect",
    interface="CircleEffect",
    has_keys=False,
)
PART_PROGRAM: Kind[PartProgram] = Kind(
    name="part_program",
    offers="the languages in which this plugin writes part programs",
    label="part program",
    door="program",
    interface="PartProgram",
    reserved=frozenset({"program"}),
    suffix=".ngc",
)
CONTROLLER: Kind[Controller] = Kind(
    name="controller",
    offers="the controls for which this plugin writes compensation tables",
    label="controller",
    door="controller",
    interface="Controller",
    reserved=frozenset({"controller"}),
    lacks=_say_unknown_confidence,
)
EXTENSION: Kind[Extension] = Kind(
    name="extension",
    offers="the groups of job keys that this plugin adds, with all that a job gets by them",
    label="extension",
    door="extension",
    interface="Extension",
)
INSTRUMENT: Kind[Instrument] = Kind(
    name="instrument",
    offers="the live instruments that this plugin reads",
    label="instrument",
    door="instrument",
    interface="Instrument",
    reserved=frozenset({"plugin"}),
)
NOTIFIER: Kind[Notifier] = Kind(
    name="notifier",
    offers="the ways in which this plugin tells people what a fleet came to",
    label="notifier",
    door="notifier",
    interface="Notifier",
    reserved=frozenset({"plugin", "tells"}),
)

#: In the order in which they are listed.
KINDS: tuple[Kind[Any], ...] = (
    STANDARD,
    SOURCE,
    RENDERER,
    EFFECT,
    CIRCLE_EFFECT,
    PART_PROGRAM,
    CONTROLLER,
    EXTENSION,
    INSTRUMENT,
    NOTIFIER,
)
