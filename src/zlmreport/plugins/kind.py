"""The kinds of plugins."""

from __future__ import annotations

from enum import Enum

from zlmreport.model.effect import Effect
from zlmreport.plugin.protocols import (
    DataSource,
    Instrument,
    PartProgram,
    ProbingProgram,
    Renderer,
    Standard,
)


class Kind(Enum):
    """What a plugin may offer: its label in messages, hook and protocol, and keys that it must not have."""

    STANDARD = ("standard", "zlmreport_standards", Standard, frozenset({"standard", "tolerances"}))
    SOURCE = ("data source", "zlmreport_sources", DataSource, frozenset({"plugin"}))
    RENDERER = ("format", "zlmreport_renderers", Renderer, frozenset[str]())
    EFFECT = ("effect", "zlmreport_effects", Effect, frozenset[str]())
    PART_PROGRAM = ("part program", "zlmreport_part_programs", PartProgram, frozenset({"program"}))
    INSTRUMENT = ("instrument", "zlmreport_instruments", Instrument, frozenset({"plugin"}))
    PROBING_PROGRAM = (
        "probing program",
        "zlmreport_probing_programs",
        ProbingProgram,
        frozenset({"program"}),
    )

    def __init__(self, label: str, hook: str, protocol: type, reserved: frozenset[str]) -> None:
        self.label = label
        self.hook = hook
        self.protocol = protocol
        self.reserved = reserved
