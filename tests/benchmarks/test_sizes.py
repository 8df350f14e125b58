"""The size of a hidden effect is that of what the job's model cannot imitate."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from hidden_effects.drawn_axes import drawn_linear_test, drawn_rotary_test
from hidden_effects.sizes import base_columns, beyond, drawn_theta, scaled_effect
from model.axis_tests import EFFECTS
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import Description
from zlmreport.model.simulation.simulate import compute_deviation_by, make_design_of
from zlmreport.plugin.effect import Design

BASE = [EFFECTS["polynomial"], EFFECTS["backlash"]]
OF_ROTARY = {"eccentricity", "ellipticity", "gear-mesh", "lost-motion-turn"}
#: They need the faces of a gauge, a pause, another log, or keys that no drawn axis states.
NOT_DRAWN = {
    *("probe-radius", "gauge-misalignment", "growth-after-pause", "material-expansion"),
    *("pole-pitch", "scale-elements"),
}
DRAWN = {"linear": drawn_linear_test, "rotary": drawn_rotary_test}


def _design(seed: int = 0, method: Method = Method.LINEAR) -> Design:
    return make_design_of(drawn_linear_test(np.random.default_rng(seed), method))


@pytest.mark.parametrize("identifier", sorted(EFFECTS))
@pytest.mark.parametrize("method", [Method.LINEAR, Method.PENDULUM, Method.QUASI_PILGRIM])
def test_drawn_effect_has_the_stated_size_beyond_the_model(identifier: str, method: Method) -> None:
    random = np.random.default_rng(3)
    draw = DRAWN["rotary" if identifier in OF_ROTARY else "linear"]
    design = make_design_of(draw(random, method))
    effect = EFFECTS[identifier]
    if effect.untestable(design):
        assert identifier in NOT_DRAWN
        return
    base = base_columns([EFFECTS["offset"]], design)
    drawn = scaled_effect(effect, design, base, 0.8e-6, random)
    if identifier == "offset":
        assert drawn is None
        return
    assert drawn is not None
    left = beyond(base, compute_deviation_by(effect, design, drawn.fixed)[:, np.newaxis])
    assert np.sqrt(np.mean(left**2)) == pytest.approx(0.8e-6, rel=1e-9)


@pytest.mark.parametrize("identifier", ["offset", "scale-error", "backlash", "cosine-error"])
def test_effect_that_the_model_imitates_entirely_is_none(identifier: str) -> None:
    design = _design()
    base = base_columns(BASE, design)
    assert scaled_effect(EFFECTS[identifier], design, base, 1e-6, np.random.default_rng(1)) is None


def test_size_that_cannot_be_negative_is_not_drawn_so() -> None:
    design = _design()
    base = base_columns([EFFECTS["offset"]], design)
    for seed in range(20):
        drawn = scaled_effect(EFFECTS["scale-expansion"], design, base, 1e-6, np.random.default_rng(seed))
        assert drawn is not None
        assert drawn.fixed["expansion"] > 0


def test_warm_up_hides_in_a_pendulum_test_and_shows_in_a_linear_one() -> None:
    shares = {}
    for method in (Method.LINEAR, Method.PENDULUM):
        design = _design(method=method)
        growth = EFFECTS["thermal-growth"].columns(design, np.array([0.3 * design.duration]))
        left = beyond(base_columns(BASE, design), growth)
        shares[method] = np.linalg.norm(left) / np.linalg.norm(growth - growth.mean())
    assert shares[Method.LINEAR] > 10 * shares[Method.PENDULUM]


def test_what_is_beyond_a_model_is_orthogonal_to_it() -> None:
    design = _design()
    base = base_columns([*BASE, EFFECTS["offset"]], design)  # its columns depend on each other
    deviation = np.random.default_rng(1).standard_normal((len(design.position), 2))
    left = beyond(base, deviation)
    assert np.abs(base.T @ left).max() < 1e-10
    np.testing.assert_allclose(beyond(base, left), left, atol=1e-12)


def test_theta_lies_within_the_grid() -> None:
    design = _design()
    grid = EFFECTS["reversal-relaxation"].grid(design)
    drawn = [
        drawn_theta(EFFECTS["reversal-relaxation"], design, np.random.default_rng(k))[0] for k in range(50)
    ]
    assert grid.min() <= min(drawn) < max(drawn) <= grid.max()
    assert not set(drawn) <= set(grid[:, 0].tolist())


def test_theta_of_a_joint_is_one_of_the_grid() -> None:
    design = _design()
    grid = EFFECTS["scale-joint"].grid(design)
    drawn = [drawn_theta(EFFECTS["scale-joint"], design, np.random.default_rng(k))[0] for k in range(50)]
    assert set(drawn) <= set(grid[:, 0].tolist())


@pytest.mark.parametrize("draw", DRAWN.values(), ids=DRAWN)
def test_drawn_tests_are_those_of_a_workshop(draw: Callable[..., Description]) -> None:
    for seed in range(10):
        description = draw(np.random.default_rng(seed), Method.LINEAR)
        design = make_design_of(description)
        assert len(design.position) == 2 * 5 * len(description.plan.targets)
        assert 900 < design.duration < 5400
        lacking = {
            identifier for identifier, effect in EFFECTS.items() if effect.untestable(design) is not None
        }
        assert lacking & {"offset", "backlash", "thermal-drift", "periodic", "datum-temperature"} == set()


def test_drawn_tests_differ() -> None:
    one, other = (drawn_linear_test(np.random.default_rng(seed), Method.LINEAR) for seed in (1, 2))
    assert not np.any(one.plan.targets == other.plan.targets)
    assert one.axis.compensation_table != other.axis.compensation_table
    assert one.seed != other.seed
