"""The built-in effects, and the tests on which each can be tested."""

from __future__ import annotations

from collections.abc import Mapping

from installed import registry
from zlmreport.plugin.effect import Design, Effect
from zlmreport.testing import full_designs

EFFECTS: Mapping[str, Effect] = {effect.identifier: effect for effect in registry().effects}
ROTARY_ONLY = {"eccentricity", "ellipticity", "gear-mesh", "lost-motion-turn"}
OF_A_PAUSE = {"growth-after-pause"}


def design_for(identifier: str, method: str = "linear") -> Design:
    """Return a complete test on which an effect can be tested."""
    if identifier in OF_A_PAUSE:
        return full_designs()["a complete test with a pause"]
    kind = "rotary" if identifier in ROTARY_ONLY else method
    return full_designs()[f"a complete {kind} test"]
