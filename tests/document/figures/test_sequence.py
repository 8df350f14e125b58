"""The graph of a planned test's sequence."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.document.figures.sequence import draw_sequence
from zlmreport.model.planning.methods import Method
from zlmreport.plugin import Approach, Axis, AxisKind, Language
from zlmreport.plugin.page import figure_to_svg
from zlmreport.plugin.standard import Panel
from zlmreport.testing import sample_motion


def _panel(method: Method, runs: int = 2) -> Panel:
    motion = sample_motion(method, targets=(10.0, 20.0), runs=runs)
    (panel,) = draw_sequence(motion).panels
    return panel


def test_readings_stand_at_their_numbers_in_the_direction_of_their_approach() -> None:
    up, down = _panel(Method.LINEAR).readings
    assert (up.approach, up.x.tolist(), up.y.tolist()) == (Approach.POSITIVE, [1, 2, 5, 6], [10, 20] * 2)
    assert (down.approach, down.x.tolist(), down.y.tolist()) == (
        Approach.NEGATIVE,
        [3, 4, 7, 8],
        [20, 10] * 2,
    )


def test_unidirectional_method_has_readings_of_one_approach() -> None:
    (only,) = _panel(Method.UNIDIRECTIONAL).readings
    assert only.approach is Approach.POSITIVE


@pytest.mark.parametrize("method", Method)
def test_path_leads_through_every_reading(method: Method) -> None:
    panel = _panel(method)
    (path,) = panel.curves
    along = dict(zip(path.x.tolist(), path.y.tolist(), strict=True))
    for readings in panel.readings:
        assert [along[x] for x in readings.x.tolist()] == readings.y.tolist()


@pytest.mark.parametrize("method", Method)
def test_path_never_goes_back_in_the_order_of_readings(method: Method) -> None:
    (path,) = _panel(method).curves
    assert np.all(np.diff(path.x) > 0)


def test_axis_turns_round_between_two_readings() -> None:
    (path,) = _panel(Method.LINEAR, runs=1).curves
    assert path.x.tolist() == [0.5, 1, 2, 2.5, 3, 4, 4.5]
    assert path.y.tolist() == [5, 10, 20, 25, 20, 10, 5]


@pytest.mark.parametrize("language", Language)
def test_sequence_is_told_to_those_who_cannot_see_it(language: Language) -> None:
    told = draw_sequence(sample_motion(Method.PENDULUM)).alternative.in_language(language)
    for part in ("16", "4", "58", "5 mm"):
        assert part in told


def test_rotary_axis_has_degrees() -> None:
    turning = sample_motion(axis=Axis("C", AxisKind.ROTARY), targets=(0.0, 90.0, 180.0))
    assert draw_sequence(turning).y_unit == "°"
    assert "180°" in figure_to_svg(draw_sequence(turning), Language.ENGLISH)
