"""Every installed effect passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.effect import Effect
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import EFFECT_CHECKS, full_designs

EFFECTS = find_plugins().effects


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.identifier)
@pytest.mark.parametrize("check", EFFECT_CHECKS)
def test_conforms(effect: Effect, check: Callable[..., None]) -> None:
    check(effect, full_designs())


def test_the_effects_of_the_tutorial_are_there() -> None:
    installed = {effect.identifier for effect in EFFECTS}
    assert {"offset", "scale-error", "backlash", "screw-pitch"} <= installed


def test_confusions_are_effects_that_there_are() -> None:
    installed = {effect.identifier for effect in EFFECTS}
    assert {confusion.effect for effect in EFFECTS for confusion in effect.confusions} <= installed
