"""The axes as owners know them: faults that are known, and a model that is built from nothing."""

from __future__ import annotations

import numpy as np
import pytest

from hidden_effects.owners import LINEAR, ROTARY, build_model
from plugins.effects.installed import design_for


@pytest.mark.parametrize("name", LINEAR)
def test_a_fault_of_a_linear_axis_is_seen_in_its_readings(name: str) -> None:
    design = design_for("backlash")
    assert 0.5 < np.std(LINEAR[name](design)) < 500


def test_a_model_is_built_of_what_is_there() -> None:
    (name,) = (each for each in ROTARY if each.startswith("rotary: gear mesh"))
    told = build_model(ROTARY[name], 1, is_rotary=True)
    assert set(told.built.model.identifiers) == {"offset", "gear-mesh", "backlash"}
    assert told.built.last.error.rms < 1.15 * told.sigma


@pytest.mark.parametrize(
    ("fault", "causes"),
    [
        ("belt", {"backlash", "scale-error"}),
        ("screw worn over half its length", {"lost-motion-step", "scale-error", "backlash"}),
        ("axis that warms up", {"scale-error", "backlash", "thermal-drift"}),
        # The second joint is found where the first stands, which moves; the slope is no cosine error.
        ("two joints", {"scale-joint", "scale-joint-2", "scale-error", "backlash"}),
        ("pitch of 3", {"screw-pitch", "worn-zone", "backlash"}),
    ],
)
def test_a_fault_of_an_axis_is_built_by_its_names_down_to_the_noise(fault: str, causes: set[str]) -> None:
    (name,) = (each for each in LINEAR if each.startswith(fault))
    told = build_model(LINEAR[name], 1, is_rotary=False)
    assert set(told.built.model.identifiers) == {"offset", *causes}
    assert told.built.last.error.rms < 1.15 * told.sigma
    assert told.built.last.remainder is None


@pytest.mark.long
def test_a_slope_that_two_effects_share_stays_one_slope_beside_a_bump() -> None:
    (name,) = (each for each in LINEAR if each.startswith("bump"))
    told = build_model(LINEAR[name], 2, is_rotary=False)
    assert set(told.built.model.identifiers) == {"offset", "scale-error", "backlash"}
    assert told.built.last.remainder is not None
    assert told.built.last.remainder.low < 0.42 < told.built.last.remainder.high
