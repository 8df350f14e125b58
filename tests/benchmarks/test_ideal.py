"""What an ideal observer tells of several causes, and of a stranger of a known kind."""

from __future__ import annotations

import numpy as np

from hidden_effects.drawn_axes import drawn_linear_test
from hidden_effects.ideal import kind_of, tells_stranger, told_apart
from hidden_effects.sizes import base_columns
from hidden_effects.strangers import STRANGERS
from hidden_effects.trial import EFFECTS
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.simulate import make_design_of

SIGMA = 8e-7
DESIGN = make_design_of(drawn_linear_test(np.random.default_rng(1), Method.LINEAR))
CONSTANT = base_columns([EFFECTS["offset"]], DESIGN)
BACKLASH = Term(EFFECTS["backlash"], {"lost_motion": 5e-6})


def _told(*causes: Term, beside: np.ndarray = CONSTANT, sigma: float = SIGMA) -> tuple[str, ...]:
    return told_apart(causes, DESIGN, sigma, EFFECTS.values(), beside)


def test_a_large_cause_is_told_and_one_far_below_the_noise_is_not() -> None:
    assert _told(BACKLASH) == ("backlash",)
    assert _told(BACKLASH, sigma=1e-4) == ()


def test_a_cause_that_another_effect_imitates_is_not_told() -> None:
    assert _told(Term(EFFECTS["scale-error"], {"slope": -1e-5})) == ()  # a cosine error falls as well


def test_a_cause_that_others_describe_together_is_not_told() -> None:
    abbe = Term(EFFECTS["abbe"], {"abbe_offset": 0.2})
    assert _told(abbe, BACKLASH) == ("abbe", "backlash")
    everything = np.column_stack([CONSTANT, EFFECTS["abbe"].columns(DESIGN, np.empty(0))])
    assert _told(abbe, BACKLASH, beside=everything) == ("backlash",)


def test_the_kind_of_a_stranger_holds_another_shape_of_it() -> None:
    kind = kind_of(STRANGERS["smooth in position"], DESIGN, np.random.default_rng(1))
    shape = STRANGERS["smooth in position"](DESIGN, np.random.default_rng(2))
    shape = shape - shape.mean()
    left = shape - kind @ (kind.T @ shape)
    assert np.sum(left**2) < 0.05 * np.sum(shape**2)
    assert kind.shape[1] < len(DESIGN.target_positions)


def _tells(shape: np.ndarray, parameters: int, size: float = 4 * SIGMA) -> bool:
    shape = shape - shape.mean()
    shape = shape * size / np.sqrt(np.mean(shape**2))
    return tells_stranger(
        shape,
        parameters,
        causes=(BACKLASH,),
        design=DESIGN,
        sigma=SIGMA,
        effects=EFFECTS.values(),
        base=CONSTANT,
    )


def test_a_chirp_is_told_from_each_two_effects_and_one_below_the_noise_is_not() -> None:
    shape = STRANGERS["chirp in position"](DESIGN, np.random.default_rng(3))
    assert _tells(shape, 4)
    assert not _tells(shape, 4, size=0.1 * SIGMA)


def test_a_bump_is_a_worn_zone_wherever_it_lies_between_the_values_that_are_tried() -> None:
    place = (DESIGN.position - DESIGN.span[0]) / DESIGN.length
    for middle, width in ((0.437, 0.071), (0.613, 0.12)):
        assert not _tells(np.exp(-0.5 * ((place - middle) / width) ** 2), 3)


def test_a_kink_of_the_reversal_is_two_kinks() -> None:
    place = (DESIGN.position - DESIGN.span[0]) / DESIGN.length
    assert not _tells(DESIGN.direction * np.maximum(0.0, place - 0.5), 12)
