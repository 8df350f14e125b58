"""Every installed plugin passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from conformance.worked import examples_of
from installed import registry
from plugins.part_programs.controls import CONTROLS
from zlmreport.testing import (
    CIRCLE_EFFECT_CHECKS,
    EFFECT_CHECKS,
    EXTENSION_CHECKS,
    INSTRUMENT_CHECKS,
    PART_PROGRAM_CHECKS,
    RENDERER_CHECKS,
    STANDARD_CHECKS,
    InstrumentTraits,
    circle_designs,
    full_designs,
)

INSTALLED = registry()
PROGRAMS = INSTALLED.list_programs_for()
#: The names that users are promised.
STANDARDS = (
    "iso230-2:1988 iso230-2:1997 iso230-2:2006 iso230-2:2014 iso230-3 iso230-4:2005 iso230-6:2002 "
    "vdi-dgq-3441 vdi-vde-2617 nmtba"
)
CIRCLE_EFFECTS = (
    "centre-offset radius servo-lag scale-mismatch squareness servo-mismatch circle-backlash "
    "over-compensation lateral-play reversal-spikes cyclic-error bow vibration stick-slip "
    "dynamic-cross-talk drive-compliance radius-drift"
)
#: What their manuals say; a µMD has no check sum, but each line of a heterodyne one repeats what it says.
TRAITS = {
    "ids3010": InstrumentTraits(has_check_sum=False, tells_lost_beam=True),
    "nd28x": InstrumentTraits(has_check_sum=True, tells_lost_beam=True),
    "text-readout": InstrumentTraits(has_check_sum=False, tells_lost_beam=True),
    "umd0": InstrumentTraits(has_check_sum=False, tells_lost_beam=False),
    "umd1": InstrumentTraits(has_check_sum=True, tells_lost_beam=True),
    "umd2": InstrumentTraits(has_check_sum=True, tells_lost_beam=True),
}
#: Keys with which a standard defines all that it declares.
KEYS = {
    "iso230-3": {"distance": {"X": 200, "Y": 200, "Z": 200}},
    "iso230-4:2005": {"circle": {"radius": 150, "feed": 1000, "calibrated_length": True}},
    "iso230-6:2002": {"axes": {"X": [0, 500], "Y": [0, 400], "Z": [0, 300]}},
}
#: Other values of keys that the kit finds none for.
OTHER_KEYS = {
    "iso230-3": {"distance": {"X": 100, "Y": 200, "Z": 200}},
    "iso230-1:2012": {"square": {"error": 1.5, "expanded_uncertainty": 0.5}},
    "iso230-4:2005": {"circle": {"radius": 150, "feed": 1000, "calibrated_length": False}},
    "iso230-6:2002": {"axes": {"X": [0, 400], "Y": [0, 400], "Z": [0, 300]}},
    "union-jack": {"carriage": {"expanded_uncertainty": 0.1}},
}


def beside_standard(standard: Any) -> tuple[Any, ...]:
    """Return its keys, its worked examples, and other keys."""
    name = standard.identifier
    options = standard.options.model_validate(KEYS.get(name, {}))
    return options, examples_of(standard), OTHER_KEYS.get(name)


def beside_program(program: Any) -> tuple[Any, ...]:
    """Return the control that runs a part program, and no keys."""

    def run(text: str) -> list[tuple[float, float, float]]:
        machine = CONTROLS[program.identifier](text)
        return [(*stop, feed) for stop, feed in zip(machine.stops, machine.feeds, strict=True)]

    return run, {}


#: The checks of a kind, the plugins of it, and what a check is called with beside one.
KINDS: dict[str, tuple[Any, Any, Callable[[Any], tuple[Any, ...]]]] = {
    "circle effect": (CIRCLE_EFFECT_CHECKS, INSTALLED.circle_effects, lambda _: (circle_designs(),)),
    "effect": (EFFECT_CHECKS, INSTALLED.effects, lambda _: (full_designs(),)),
    "extension": (EXTENSION_CHECKS, INSTALLED.extensions, lambda _: ()),
    "instrument": (INSTRUMENT_CHECKS, INSTALLED.instruments, lambda each: (TRAITS[each.identifier],)),
    "part program": (PART_PROGRAM_CHECKS, PROGRAMS, beside_program),
    "renderer": (RENDERER_CHECKS, INSTALLED.renderers, lambda _: ()),
    "standard": (STANDARD_CHECKS, INSTALLED.standards, beside_standard),
}
CASES = [
    pytest.param(check, plugin, beside, id=f"{kind} {plugin.identifier}, {check.__name__}")
    for kind, (checks, plugins, beside) in KINDS.items()
    for plugin in plugins
    for check in checks
]


@pytest.mark.parametrize(("check", "plugin", "beside"), CASES)
def test_conforms(check: Callable[..., None], plugin: Any, beside: Callable[[Any], tuple[Any, ...]]) -> None:
    check(plugin, *beside(plugin))


@pytest.mark.parametrize(
    ("plugins", "promised"),
    [
        (INSTALLED.standards, STANDARDS),
        (INSTALLED.renderers, "pdf html json"),
        (INSTALLED.effects, "offset scale-error backlash screw-pitch"),
    ],
    ids=["standards", "formats", "effects of the tutorial"],
)
def test_what_users_are_promised_is_there(plugins: Any, promised: str) -> None:
    assert {*promised.split()} <= {plugin.identifier for plugin in plugins}


def test_the_effects_of_circles_are_those_that_machine_files_are_promised() -> None:
    assert {*CIRCLE_EFFECTS.split()} == {effect.identifier for effect in INSTALLED.circle_effects}


def test_confusions_are_effects_that_there_are() -> None:
    confused = {confusion.effect for effect in INSTALLED.effects for confusion in effect.confusions}
    assert confused <= {effect.identifier for effect in INSTALLED.effects}


def test_every_part_program_has_a_control() -> None:
    assert {program.identifier for program in PROGRAMS} == set(CONTROLS)
