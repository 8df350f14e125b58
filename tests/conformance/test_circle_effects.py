"""Every installed effect of circles passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.circle_effect import CircleEffect
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import CIRCLE_EFFECT_CHECKS, circle_designs

EFFECTS = find_plugins().circle_effects
#: The names that machine files are promised.
PROMISED = (
    "centre-offset radius servo-lag scale-mismatch squareness servo-mismatch circle-backlash "
    "over-compensation lateral-play reversal-spikes cyclic-error bow vibration stick-slip "
    "dynamic-cross-talk drive-compliance radius-drift"
)


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.identifier)
@pytest.mark.parametrize("check", CIRCLE_EFFECT_CHECKS)
def test_conforms(effect: CircleEffect, check: Callable[..., None]) -> None:
    check(effect, circle_designs())


def test_all_that_are_promised_are_there() -> None:
    assert {*PROMISED.split()} == {effect.identifier for effect in EFFECTS}
