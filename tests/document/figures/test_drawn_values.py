"""What is drawn is what was measured: values read back from the drawing by its own ticks."""

from __future__ import annotations

import numpy as np
import pytest

from document.figures.samples import (
    BACKWARD,
    FORWARD,
    ORDINARY,
    SPREAD,
    TARGETS,
    Readback,
    Recording,
    bars,
    both_directions,
    drawn,
    each_direction,
    figure,
    many_targets,
)
from zlmreport.document.figures.figure import Bar
from zlmreport.plugin import FloatArray, same_in_all_languages
from zlmreport.plugin.standard import Panel

#: Half a millionth of the height of the drawing: rounding of the straight line through the ticks.
EXACT = 1e-6


@pytest.fixture(scope="module")
def canvas() -> Recording:
    return drawn(figure(both_directions()))


@pytest.fixture(scope="module")
def readback(canvas: Recording) -> Readback:
    return Readback(canvas)


@pytest.mark.parametrize(
    ("kind", "values"),
    [
        ("curve mean_positive", FORWARD),
        ("curve mean_negative", BACKWARD),
        ("curve mean_bidirectional", (FORWARD + BACKWARD) / 2),
    ],
)
def test_a_curve_leads_through_its_values(
    canvas: Recording, readback: Readback, kind: str, values: FloatArray
) -> None:
    (curve,) = canvas.of(kind)
    np.testing.assert_allclose(readback.values(curve.points), np.column_stack([TARGETS, values]), atol=EXACT)


def test_a_curve_has_a_mark_at_each_target(canvas: Recording, readback: Readback) -> None:
    (marks,) = canvas.of("mark mean_positive")
    middles = np.array([(part.min(axis=0) + part.max(axis=0)) / 2 for part in marks.parts])
    np.testing.assert_allclose(readback.values(middles), np.column_stack([TARGETS, FORWARD]), atol=EXACT)


def test_a_band_has_both_its_limits(canvas: Recording, readback: Readback) -> None:
    lower, upper = (readback.values(limit.points)[:, 1] for limit in canvas.of("limit limit_negative"))
    np.testing.assert_allclose(lower, BACKWARD - SPREAD, atol=EXACT)
    np.testing.assert_allclose(upper, BACKWARD + SPREAD, atol=EXACT)


def test_a_band_is_filled_between_its_limits(canvas: Recording, readback: Readback) -> None:
    (band,) = canvas.of("band limit_positive")
    values = readback.values(band.points)
    assert values[:, 1].max() == pytest.approx((FORWARD + SPREAD).max(), abs=EXACT)
    assert values[:, 1].min() == pytest.approx((FORWARD - SPREAD).min(), abs=EXACT)


def test_every_reading_has_its_mark(canvas: Recording, readback: Readback) -> None:
    forward, backward = canvas.of("reading")
    panel = both_directions()
    for marks, readings in zip((forward, backward), panel.readings, strict=True):
        middles = np.array([(part.min(axis=0) + part.max(axis=0)) / 2 for part in marks.parts])
        np.testing.assert_allclose(
            readback.values(middles), np.column_stack([readings.x, readings.y]), atol=EXACT
        )


def test_arrows_span_their_values(canvas: Recording, readback: Readback) -> None:
    ends = sorted(tuple(sorted(readback.y(arrow.points[:, 1]))) for arrow in canvas.of("arrow"))
    np.testing.assert_allclose(ends, [(-1.5, 6.5), (1.0, 4.0)], atol=EXACT)


def test_arrow_heads_touch_the_values(canvas: Recording, readback: Readback) -> None:
    for shaft, heads in zip(canvas.of("arrow"), canvas.of("arrow head"), strict=True):
        tips = sorted(readback.y(part[0, 1]) for part in heads.parts)
        np.testing.assert_allclose(tips, sorted(readback.y(shaft.points[:, 1])), atol=EXACT)


def test_extension_lines_lead_from_the_target_of_an_arrow_to_it(
    canvas: Recording, readback: Readback
) -> None:
    (extensions,) = canvas.of("extension")
    ends = np.array([part[0] for part in extensions.parts[:4]])
    gap = readback.x(3.0) - readback.x(0.0)
    np.testing.assert_allclose(np.abs(readback.x(ends[:, 0]) - 250.0), gap, atol=EXACT)


def test_brackets_span_their_parameters(canvas: Recording, readback: Readback) -> None:
    spans = {
        text.text: tuple(sorted(readback.y(bracket.points[:, 1]).tolist()))
        for text, bracket in zip(canvas.texts_of("bracket"), canvas.of("bracket"), strict=True)
    }
    assert spans == {
        "A": pytest.approx((-6.5, 7.5), abs=EXACT),
        "E": pytest.approx((-5.0, 6.5), abs=EXACT),
        "M": pytest.approx((-3.75, 5.0), abs=EXACT),
    }


def test_extension_lines_lead_from_where_an_extreme_arises_to_its_bracket(
    canvas: Recording, readback: Readback
) -> None:
    (extensions,) = canvas.of("extension")
    of_longest = extensions.parts[-2:]
    gap = float(readback.x(3.0) - readback.x(0.0))
    starts = readback.values(np.array([part[0] for part in of_longest]))
    np.testing.assert_allclose(starts, [(500.0 + gap, -6.5), (1000.0 + gap, 7.5)], atol=EXACT)
    bracket = canvas.of("bracket")[-1]
    assert all(part[1, 0] > bracket.points[0, 0] for part in of_longest)


def test_a_level_lies_at_its_value(canvas: Recording, readback: Readback) -> None:
    (level,) = canvas.of("level")
    np.testing.assert_allclose(readback.y(level.points[:, 1]), 8.0, atol=EXACT)


def test_the_zero_line_lies_at_zero(canvas: Recording, readback: Readback) -> None:
    (zero,) = canvas.of("zero")
    np.testing.assert_allclose(readback.y(zero.points[:, 1]), 0.0, atol=EXACT)


def test_no_value_of_200_targets_is_simplified_away() -> None:
    canvas = drawn(figure(many_targets()))
    (curve,) = canvas.of("curve mean_positive")
    x = np.round(Readback(canvas).x(curve.points[:, 0]), 3)
    np.testing.assert_array_equal(x, np.round(many_targets().curves[0].x, 3))


def test_a_missing_value_leaves_a_gap() -> None:
    with_gap = each_direction()[0]
    values = FORWARD.copy()
    values[2] = np.nan
    curve = with_gap.curves[0]
    panel = type(with_gap)(curves=(type(curve)(curve.notation, curve.role, TARGETS, values),))
    (line,) = drawn(figure(panel)).of("curve mean_positive")
    assert [len(part) for part in line.parts] == [2, 2]


def test_two_panels_draw_lengths_alike() -> None:
    canvas = drawn(figure(*each_direction()))
    upper, lower = (bracket.points for bracket in canvas.of("bracket"))
    assert np.ptp(upper[:, 1]) == pytest.approx(np.ptp(lower[:, 1]), abs=EXACT)


def test_two_panels_share_the_positions() -> None:
    canvas = drawn(figure(*each_direction()))
    (forward,), (backward,) = canvas.of("curve mean_positive"), canvas.of("curve mean_negative")
    np.testing.assert_allclose(forward.points[:, 0], backward.points[:, 0], atol=EXACT)


def test_bars_grow_from_zero_to_their_values() -> None:
    canvas = drawn(figure(bars(5.0, 3.0, 0.5)))
    readback = Readback(canvas)
    ends = [tuple(sorted(set(np.round(readback.y(bar.points[:, 1]), 6)))) for bar in canvas.of("bar")]
    assert ends == [(0.0, 5.0), (0.0, 3.0), (0.0, 0.5)]


def test_a_whisker_reaches_as_far_as_the_uncertainty_to_both_sides() -> None:
    canvas = drawn(
        figure(
            Panel(
                bars=(Bar(same_in_all_languages("A"), 60.0, same_in_all_languages("60"), uncertainty=15.0),)
            )
        )
    )
    (whisker,) = canvas.of("whisker")
    ends = sorted(set(np.round(Readback(canvas).y(whisker.points[:, 1]), 6)))
    assert ends == [45.0, 75.0]


def test_an_acceptance_limit_crosses_its_bar() -> None:
    canvas = drawn(
        figure(
            Panel(bars=(Bar(same_in_all_languages("A"), 60.0, same_in_all_languages("60"), accepted=80.0),))
        )
    )
    (bar,), (accepted,) = canvas.of("bar"), canvas.of("accepted")
    assert set(np.round(Readback(canvas).y(accepted.points[:, 1]), 6)) == {80.0}
    assert accepted.points[:, 0].min() < bar.points[:, 0].min()
    assert accepted.points[:, 0].max() > bar.points[:, 0].max()


def test_bars_stand_above_their_names_and_below_their_values() -> None:
    canvas = drawn(figure(bars(5.0, 3.0, names=("one", "other"))))
    for bar, name, value in zip(
        canvas.of("bar"), canvas.texts_of("tick x"), canvas.texts_of("bar"), strict=True
    ):
        middle = (bar.points[:, 0].min() + bar.points[:, 0].max()) / 2
        for text in (name, value):
            assert (text.box.left + text.box.right) / 2 == pytest.approx(middle, abs=1e-6)
        assert value.box.top < bar.points[:, 1].min()  # y downwards
    assert [text.text for text in canvas.texts_of("bar")] == ["5.00", "3.00"]


def test_panels_with_spans_of_their_own_draw_lengths_each_in_its_own() -> None:
    canvas = drawn(ORDINARY["a panel of what another leaves"])
    upper, lower = (curve.points[:, 1] for curve in canvas.of("curve mean_positive"))
    assert np.ptp(lower) == pytest.approx(np.ptp(upper), rel=1e-6)


def test_a_disc_is_as_wide_as_its_mark_and_round() -> None:
    canvas = drawn(figure(both_directions()))
    (marks,) = canvas.of("mark mean_bidirectional")
    segments = marks.segments[: next(n for n, (operator, _) in enumerate(marks.segments) if operator == "Z")]
    ends = np.array([points[-2:] for _, points in segments])
    middle = (ends.min(axis=0) + ends.max(axis=0)) / 2
    np.testing.assert_allclose(np.hypot(*(ends - middle).T), 3.8 / 2, rtol=1e-9)
    # Half way along each curve a circle of four of them is true to 3 parts in 10 000.
    for start, (_, curve) in zip(ends, segments[1:], strict=False):
        points = np.array([start, *np.reshape(curve, (3, 2))])
        half_way = np.array([1, 3, 3, 1]) @ points / 8
        assert np.hypot(*(half_way - middle)) == pytest.approx(3.8 / 2, rel=3e-4)
