"""The union jack: Moody's own plate, plates whose heights are known, and lines that do not fit together."""

from __future__ import annotations

import csv
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from installed import registry
from plugins.standards.union_jack.plates import evaluated, line, read, values
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import Axis, Language, MeasurementSet, Words
from zlmreport.plugin.extension import Acts, Contribution
from zlmreport.testing import bidirectional_test
from zlmreport_plugins.standards.union_jack.heights import find_plate_of
from zlmreport_plugins.union_jack_lines import FLATNESS, LINE, LINES, reverse_name

DATA = Path(__file__).parents[3] / "data" / "flatness" / "moody_1955.csv"


def moody() -> dict[str, MeasurementSet]:
    readings = defaultdict(list)
    with DATA.open(encoding="utf-8") as file:
        for row in csv.DictReader(each for each in file if not each.startswith("#")):
            readings[row["line"]].append(float(row["reading"]))
    return {name: line(name, of_line, foot=101.6) for name, of_line in readings.items()}


def test_moodys_plate_of_1955() -> None:
    """As the corrected worksheet has it: 9.2″ over feet of 4 inch; from east to west it closes to −0.7″."""
    found = values(moody())
    assert found["t"] == pytest.approx(4.532, abs=5e-4)
    assert found["closure_WE"] == pytest.approx(-0.345, abs=5e-4)
    assert found["closure_NS"] == pytest.approx(0, abs=1e-9)
    assert found["t_MZ"] < found["t_LS"] < found["t"]


def test_moodys_corners() -> None:
    plate = find_plate_of(evaluated(moody()).statistics.tests)
    arc_seconds = {name: each.heights * 1e6 / 0.49257 for name, each in plate.profiles.items()}
    assert arc_seconds["NW-SE"][[0, -1]] == pytest.approx([-3.6, -3.6], abs=1e-4)
    assert arc_seconds["NE-SW"][[0, -1]] == pytest.approx([-5.3, -5.3], abs=1e-4)
    assert min(each.min() for each in arc_seconds.values()) == pytest.approx(-6.8, abs=1e-3)
    assert max(each.max() for each in arc_seconds.values()) == pytest.approx(2.4, abs=1e-3)


@given(st.floats(-5, 5), st.floats(-5, 5), st.floats(-50, 50))
def test_a_tilted_plane_is_flat_whatever_the_zero_of_the_instrument(a: float, b: float, zero: float) -> None:
    found = values(read(lambda x, y: a * x / 100 + b * y / 100, zero=zero))
    assert found == pytest.approx(dict.fromkeys(found, 0.0), abs=1e-8)


def test_a_hollow_plate_by_its_heights() -> None:
    """5 µm at the corners, 0 in the middle: every line sees its part, and the lines close."""
    found = values(read(lambda x, y: 5 * ((x - 400) ** 2 + (y - 300) ** 2) / 250_000))
    assert found["t"] == pytest.approx(5)
    assert (found["closure_WE"], found["closure_NS"]) == pytest.approx((0, 0), abs=1e-9)


def test_a_twisted_plate_lies_half_above_and_half_below_the_base_plane() -> None:
    found = values(read(lambda x, y: 4 * (x - 400) * (y - 300) / 120_000))
    assert (found["t"], found["t_LS"], found["t_MZ"]) == pytest.approx((8, 8, 8))


@given(st.sets(st.sampled_from(LINES)))
def test_a_line_may_be_measured_the_other_way(turned: set[str]) -> None:
    def height(x: float, y: float) -> float:
        return 3e-6 * (x - 300) ** 2 + 5e-6 * (x - 400) * (y - 200)

    usual = values(read(height))
    names = [reverse_name(name) if name in turned else name for name in LINES]
    assert values(read(height, names)) == pytest.approx(usual)


def test_several_readings_of_a_line_are_averaged() -> None:
    lines = read(lambda x, _: 1e-5 * (x - 400) ** 2)
    doubled = dict(lines)
    scatter = np.random.default_rng(5).normal(0, 1e-6, 8)
    first = lines["W-E"].deviations()[0, :, 0]
    arc = np.stack([first + scatter, first - scatter], axis=-1) / (np.pi / 180 / 3600)
    doubled["W-E"] = bidirectional_test(
        np.arange(1, 9) * 100.0, arc, np.full_like(arc, np.nan), axis=Axis("W-E", quantity=LINE)
    )
    assert values(doubled) == pytest.approx(values(lines))


def test_a_line_that_is_not_there_leaves_no_height() -> None:
    lines = read(lambda x, _: x / 100)
    del lines["N-S"]
    found = evaluated(lines)
    assert not found.parameters
    assert "N-S" in found.findings[0].found.in_language(Language.ENGLISH)


def test_a_missing_reading_leaves_no_height() -> None:
    lines = read(lambda x, _: x / 100)
    lines["N-S"] = line("N-S", [1, 2, np.nan, 4, 5, 6])
    assert values(lines).keys() == {"closure_WE"}


def test_lines_that_do_not_close_are_told() -> None:
    lines = read(lambda _x, _y: 0.0)
    lines["W-E"] = line("W-E", [6, 6, 6, 6, -6, -6, -6, -6])
    assert [each.met for each in evaluated(lines).findings][-1] is False


def test_diagonals_that_do_not_fit_the_edges_are_told() -> None:
    lines = read(lambda _x, _y: 0.0)
    lines["NW-SE"] = line("NW-SE", [0] * 12)
    assert False in [each.met for each in evaluated(lines).findings]


HOLLOW = read(lambda x, y: 1e-5 * ((x - 400) ** 2 + (y - 300) ** 2))


def of_the_feet(stated: dict[str, float]) -> dict[str, Contribution]:
    """Return what the standard adds to each line of a hollow plate for the carriage."""
    standard = registry().standard("union-jack")
    options = standard.options.model_validate({"carriage": stated})
    found = standard.contributions(join_lines(Axis("plate", quantity=FLATNESS), HOLLOW), options)
    return {name: each for name, (each,) in found.items()}


def test_wrong_feet_change_every_reading_by_one_share_on_all_lines() -> None:
    found = of_the_feet({"expanded_uncertainty": 0.5})  # of 100 mm, k = 2: u is 0.25 %
    assert set(found) == set(LINES)
    for name, each in found.items():
        largest = np.nanmax(np.abs(HOLLOW[name].deviation))
        assert (each.contributor, each.acts) == ("foot_spacing", Acts.WITH_THE_READING)
        assert each.standard_uncertainty == pytest.approx(0.0025 * largest)
    assert len({each.shared_as for each in found.values()}) == 1


def test_feet_of_which_nothing_is_stated_are_missing_in_u() -> None:
    assert of_the_feet({}) == {}
    assert FLATNESS.contributors == ("foot_spacing",)


def test_a_line_of_one_reading_gives_no_flatness() -> None:
    """Its ends are all that it has; a plate of nothing but ends would be flat."""
    one = {**HOLLOW, "N-S": line("N-S", [5.0], foot=600.0)}
    assert values(one) == {}


def test_corners_are_called_as_the_lines_through_them_in_every_language() -> None:
    standard = registry().standard("union-jack")
    _, plan = standard.figures(evaluated(moody()), standard.options())
    words = [each.value for each in plan.panels[0].notes if isinstance(each.value, Words)]
    for language in Language:
        assert [each.in_language(language) for each in words] == ["NW", "NE", "SE", "SW"]
