"""The small graph holds what it says it shows."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from xml.etree import ElementTree as ET

from fleet.histories import entry, history, judged, parameter, quarters
from zlmreport.fleet.records import LedgerEntry
from zlmreport.fleet.trend_graph import LARGE, SMALL, GraphSize, Period, draw_trend
from zlmreport.plugin import DecimalSign

PERIOD = Period(quarters(8)[0], quarters(8)[-1])


def drawn(
    entries: Sequence[LedgerEntry], period: Period = PERIOD
) -> list[tuple[str, list[tuple[float, float]]]]:
    """Return the class and the points of each outline."""
    (trend,) = judged(entries)
    image = ET.fromstring(draw_trend(trend, period, "words", DecimalSign.POINT))
    found = []
    for path in image.iter("{http://www.w3.org/2000/svg}path"):
        numbers = list(map(float, re.findall(r"-?[\d.]+", path.attrib["d"])))
        found.append((path.attrib["class"], list(zip(numbers[::2], numbers[1::2], strict=True))))
    return found


def outlines(
    kind: str, entries: Sequence[LedgerEntry], period: Period = PERIOD
) -> list[list[tuple[float, float]]]:
    return [points for name, points in drawn(entries, period) if name == kind]


def test_the_course_has_a_place_for_each_calibration() -> None:
    (course,) = outlines("course", history([8.0, 9.0, 7.0]))
    assert len(course) == 3


def test_values_are_drawn_to_the_scale_of_the_limit() -> None:
    entries = history([10.0, 5.0, 10.0], limit=20.0)
    (course,), (limit,), (zero,) = (outlines(kind, entries) for kind in ("course", "limit", "zero"))
    height = zero[0][1] - limit[0][1]
    assert [round((zero[0][1] - y) / height, 3) for _, y in course] == [0.5, 0.25, 0.5]


def test_dates_are_drawn_to_the_scale_of_the_period() -> None:
    (course,) = outlines("course", history([8.0] * 8))
    steps = [later[0] - earlier[0] for earlier, later in itertools.pairwise(course)]
    assert max(steps) - min(steps) < 0.01


def test_the_band_is_as_wide_as_twice_the_uncertainty() -> None:
    entries = history([10.0, 10.0], limit=20.0)
    (band,), (limit,), (zero,) = (outlines(kind, entries) for kind in ("band", "limit", "zero"))
    micrometre = (zero[0][1] - limit[0][1]) / 20.0
    heights = [y for _, y in band]
    assert round(max(heights) - min(heights), 2) == round(2 * micrometre, 2)


def test_a_drift_leads_on_behind_the_last_calibration() -> None:
    entries = history([8.0, 9.1, 9.9, 11.0, 12.1, 12.9, 14.0, 15.1])
    (course,), (drift,) = (outlines(kind, entries) for kind in ("course", "drift"))
    assert drift[-1][0] > course[-1][0]


def test_no_drift_is_no_line() -> None:
    assert outlines("drift", history([8.0, 8.2, 8.1, 8.0, 8.1])) == []


def test_a_value_that_does_not_conform_is_a_cross() -> None:
    first, second = quarters(2)
    entries = [entry(first, parameter(19.0)), entry(second, parameter(21.0, conforms=False))]
    assert len(outlines("point", entries)) == 1
    assert len(outlines("point not-met", entries)) == 1


def test_a_signed_value_has_both_limits() -> None:
    assert len(outlines("limit", history([-3.0, 2.0], limit=5.0))) == 2


def test_an_amount_has_one_limit() -> None:
    assert len(outlines("limit", history([3.0, 2.0], limit=5.0))) == 1


def test_a_value_without_uncertainty_has_no_band() -> None:
    assert outlines("band", [entry(quarters(1)[0], parameter(3.0, expanded_uncertainty=None))]) == []


def test_a_single_calibration_of_zero_stays_on_the_drawing() -> None:
    (day,) = quarters(1)
    single = [entry(day, parameter(0.0, expanded_uncertainty=None, limit=None, conforms=None))]
    points = [point for _, outline in drawn(single, Period(day, day)) for point in outline]
    assert all(0 <= x <= SMALL.width and -3 <= y <= SMALL.height + 3 for x, y in points)


def lettering(entries: Sequence[LedgerEntry], size: GraphSize, sign: DecimalSign) -> list[str]:
    (trend,) = judged(entries)
    image = ET.fromstring(draw_trend(trend, PERIOD, "words", sign, size))
    return ["".join(text.itertext()) for text in image.iter("{http://www.w3.org/2000/svg}text")]


def test_a_small_graph_has_a_scale_of_values_and_of_time() -> None:
    words = lettering(history([8.0, 8.2, 8.1]), SMALL, DecimalSign.POINT)
    assert words == ["0", "20", "2025-01", "2026-10"]


def test_the_date_of_a_first_night_is_on_the_drawing() -> None:
    (only,) = quarters(1)
    (trend,) = judged([entry(only, parameter(8.0))])
    image = ET.fromstring(draw_trend(trend, Period(only, only), "words", DecimalSign.POINT))
    date = list(image.iter("{http://www.w3.org/2000/svg}text"))[-1]
    assert "".join(date.itertext()) == "2025-01"
    starts = [float(each.attrib["x"]) for each in date.iter() if "x" in each.attrib]
    assert min(starts) > SMALL.left


def test_a_large_graph_has_its_unit_and_a_line_for_each_year() -> None:
    words = lettering(history([0.8, 0.82, 0.81], limit=1.2), LARGE, DecimalSign.COMMA)
    assert words == ["0,0", "0,5", "1,0", "1,5 µm", "2026", "2027"]
