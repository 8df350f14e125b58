"""From evaluations to the marks of their graphs: units, order of ends, targets of one direction."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.plugin import Approach, Evaluation, Options
from zlmreport.plugin.standard import Diagram, Role, diagram_panel, evaluate, worst_position
from zlmreport.testing import bidirectional_test

NAN = math.nan
ISO = STANDARDS["iso230-2:2014"]
TEST = bidirectional_test(
    [0, 100, 200], [[1.0, 3.0], [4.0, NAN], [NAN, NAN]], [[NAN, NAN], [NAN, NAN], [NAN, NAN]]
)
DIAGRAM = Diagram(evaluate(ISO, TEST, ISO.options(), {}))
NOWHERE = np.full(3, NAN)


def test_worst_is_the_target_with_the_largest_defined_value() -> None:
    assert worst_position(np.array([1.0, NAN, 5.0, 2.0])) == 2
    assert worst_position(np.array([NAN, NAN])) is None


def test_values_in_metres_become_micrometres_over_millimetres() -> None:
    found = DIAGRAM.curve("x", Role.MEAN_POSITIVE, np.array([1e-6, NAN, 3e-6]))

    assert found is not None
    assert found.x.tolist() == pytest.approx([0, 100, 200])
    assert found.y.tolist() == pytest.approx([1, NAN, 3], nan_ok=True)
    assert not found.y.flags.writeable


def test_what_is_defined_nowhere_gives_no_mark() -> None:
    assert DIAGRAM.curve("x", Role.MEAN_POSITIVE, NOWHERE) is None
    assert DIAGRAM.band("x", Role.SPREAD, NOWHERE, np.ones(3)) is None
    assert DIAGRAM.arrow("x", 1, np.ones(3), NOWHERE) is None
    assert DIAGRAM.arrow("x", None, np.ones(3), np.ones(3)) is None
    assert DIAGRAM.level("x", Role.BAND_LIMIT, NAN) is None
    assert DIAGRAM.bracket("A", np.ones(3), np.ones(3)) is None


def test_a_band_is_drawn_where_both_its_limits_are_defined_somewhere() -> None:
    assert DIAGRAM.band("x", Role.SPREAD, np.array([NAN, 1e-6, NAN]), np.ones(3)) is not None
    assert DIAGRAM.band("x", Role.SPREAD, np.array([NAN, 1e-6, NAN]), np.array([1e-6, NAN, NAN])) is None


def test_the_ends_of_an_arrow_come_lower_one_first() -> None:
    found = DIAGRAM.arrow("x", 2, np.full(3, 5e-6), np.full(3, -1e-6))

    assert found is not None
    assert (found.x, found.low, found.high) == pytest.approx((200, -1, 5))


def test_readings_show_what_there_is_of_each_direction() -> None:
    (found,) = DIAGRAM.readings()

    assert found.approach is Approach.POSITIVE
    assert found.x.tolist() == pytest.approx([0, 100, 0])
    assert found.y.tolist() == pytest.approx([1, 4, 3])
    assert DIAGRAM.readings(Approach.NEGATIVE) == ()


def test_a_bracket_takes_its_notation_from_the_standard_and_its_ends_from_either_direction() -> None:
    upper = np.array([[1e-6, 2e-6, NAN], [NAN, 4e-6, 7e-6]])
    lower = np.array([[-3e-6, 0.0, NAN], [NAN, -1e-6, -3e-6]])
    found = DIAGRAM.bracket("E_fwd", lower, upper)

    assert found is not None
    assert found.notation == "E↑"
    assert (found.low, found.low_at, found.high, found.high_at) == pytest.approx((-3, 0, 7, 200))


def test_a_panel_leaves_out_what_is_not_defined() -> None:
    level = DIAGRAM.level("x", Role.BAND_LIMIT, 0.0)
    shown = diagram_panel(curves=[None], levels=[None, level])

    assert (shown.curves, shown.levels) == ((), (level,))


def evaluation(*, one_sided: bool) -> Evaluation:
    positive = np.array([[1.0], [NAN], [3.0]])
    negative = np.array([[NAN], [2.0], [NAN]])
    test = bidirectional_test([0.0, 10.0, 20.0], positive, negative)
    return evaluate(ISO, replace(test, one_sided_targets=one_sided), Options(), {})


@pytest.mark.parametrize(("one_sided", "positions"), [(True, [0.0, 20.0]), (False, [0.0, 10.0, 20.0])])
def test_a_line_has_a_gap_only_where_a_reading_is_missing(one_sided: bool, positions: list[float]) -> None:
    found = evaluation(one_sided=one_sided)
    curve = Diagram(found).curve("x̄", Role.MEAN_POSITIVE, found.statistics.mean_positive)
    assert curve is not None
    assert curve.x == pytest.approx(positions)
