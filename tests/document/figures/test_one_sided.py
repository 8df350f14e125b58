"""Where a target can be reached in one direction only, lines lead from one such target to the next."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from zlmreport.plugin import Evaluation, Options
from zlmreport.plugin.registry import find_plugins
from zlmreport.plugin.standard import Diagram, Role, evaluate
from zlmreport.testing import bidirectional_test

ISO = find_plugins().standard("iso230-2:2014")
NAN = float("nan")


def evaluation(*, one_sided: bool) -> Evaluation:
    positive = np.array([[1.0], [NAN], [3.0]])
    negative = np.array([[NAN], [2.0], [NAN]])
    test = bidirectional_test([0.0, 10.0, 20.0], positive, negative)
    return evaluate(ISO, replace(test, one_sided_targets=one_sided), Options(), {})


@pytest.mark.parametrize(("one_sided", "positions"), [(True, [0.0, 20.0]), (False, [0.0, 10.0, 20.0])])
def test_a_line_has_a_gap_only_where_a_reading_is_missing(one_sided: bool, positions: list[float]) -> None:  # noqa: FBT001 - a parameter
    found = evaluation(one_sided=one_sided)
    curve = Diagram(found).curve("x̄", Role.MEAN_POSITIVE, found.statistics.mean_positive)
    assert curve is not None
    assert curve.x == pytest.approx(positions)
