"""What happens where an axis turns: what is said of lost motion, and where a spike is looked for."""

import numpy as np
import pytest

from installed import registry
from machines.simulated import circle, nothing
from zlmreport.machines.design import clear_of_reversals, make_thinned_design
from zlmreport.plugin import MICROMETRE, Language
from zlmreport.plugin.circle_effect import Estimate


def said(*estimates: tuple[str, float, float], of: str = "circle-backlash") -> list[str]:
    """Return the sentences on what an effect found, of values with their U in µm."""
    effect = next(each for each in registry().circle_effects if each.identifier == of)
    found = [Estimate(name, MICROMETRE, value * 1e-6, u * 1e-6) for name, value, u in estimates]
    return [each.in_language(Language.ENGLISH) for each in effect.findings(found)]


def test_lost_motion_is_said_with_its_axis_and_what_to_do() -> None:
    loses, mend = said(("X", 5.2, 0.4), ("Y", 0.1, 0.4))
    assert loses == "X loses 5.20 ± 0.40 µm where it turns, alike at both ends of the circle"
    assert "backlash compensation" in mend


def test_an_end_that_loses_more_is_said_where_it_lies() -> None:
    upper, ends, _ = said(("Y+", 8.0, 0.5), ("Y−", 0.2, 0.5))
    assert upper == "Y loses 8.00 ± 0.50 µm where it turns at the end of larger Y"
    assert "one value of the control does not suit both" in ends


def test_ends_that_agree_within_their_uncertainties_are_not_said_to_differ() -> None:
    assert len(said(("Z+", 6.1, 0.3), ("Z−", 5.9, 0.3))) == 3


@pytest.mark.parametrize("value", [0.3, -3.0])
def test_what_lies_within_its_uncertainty_or_is_over_compensated_is_no_lost_motion(value: float) -> None:
    assert said(("X", value, 0.4)) == []


def test_lateral_play_is_said_with_its_axis_whichever_way_it_shifts() -> None:
    play = said(("X", -3.1, 0.4), ("Y", 0.1, 0.4), of="lateral-play")
    assert play == ["X shifts sideways by −3.10 ± 0.40 µm where it turns"]


@pytest.mark.parametrize("first", [0.0, 0.03])
def test_an_axis_that_turned_in_the_feed_in_has_its_spike_at_the_beginning_of_a_turn(first: float) -> None:
    """X turns at 0° and 180°: each turn shows two spikes of it, though no reading lies at 0° itself."""
    design = make_thinned_design([clear_of_reversals(circle(nothing, noise=0.0, first=first))]).fine
    effect = next(each for each in registry().circle_effects if each.identifier == "reversal-spikes")
    column = next(each for each in effect.terms(design, effect.grid(design)[0]) if each.name == "X").column
    for turn in design.turns.tolist():
        own = design.turn == turn
        beyond = np.cos(design.angle[own]) > 0
        sizes = np.sum(column[own][beyond] ** 2), np.sum(column[own][~beyond] ** 2)
        assert sizes[0] == pytest.approx(sizes[1], rel=0.35)
