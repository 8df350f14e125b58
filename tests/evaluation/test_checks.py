"""Requirements that several standards share, and how their numbers read."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.findings import said
from zlmreport.evaluation.checks import measured_approaches
from zlmreport.plugin import Approach, Axis, AxisKind, Language, MeasurementSet, Words
from zlmreport.plugin.standard import (
    Basis,
    Finding,
    both_directions,
    deviation_in_words,
    exceeds,
    fewest_runs,
    mean_interval,
    no_missing_readings,
    number_of_runs,
    position_in_words,
    positions_by_angle,
    positions_in_all,
    positions_in_words,
    positions_over_travel,
    positions_per_metre,
    positions_per_scale_element,
    principal_angles,
    random_fractions,
    runs_in_words,
    spacing_against_periods,
)
from zlmreport.testing import bidirectional_test, simulated_test

BY_ANGLE = {math.pi / 2: 3, math.pi: 5}
CONSEQUENCE = Words("no reversal", "keine Umkehrspanne")
LINEAR, ROTARY = Axis("X"), Axis("C", AxisKind.ROTARY)
FORMULA = "P = N·p + r"
HIDDEN = "all targets at the same phase: a deviation of this period stays hidden"


def measured_at(*targets: float, axis: Axis | None = None) -> MeasurementSet:
    """Return a test at these targets, mm (°)."""
    readings = np.zeros((len(targets), 1))
    return bidirectional_test(targets, readings, readings, axis=axis)


def evenly(first: float, last: float, number: int, axis: Axis | None = None) -> MeasurementSet:
    return measured_at(*np.linspace(first, last, number), axis=axis)


def rotary(*targets: float) -> MeasurementSet:
    return measured_at(*targets, axis=Axis("C", AxisKind.ROTARY))


@pytest.mark.parametrize(("number", "met"), [(10, False), (11, True)])
def test_positions_in_all(number: int, met: bool) -> None:
    found = positions_in_all(evenly(0, 300, number), 11, Basis.PUBLISHED)

    assert said(found) == ("At least 11 positions", f"{number} positions", met)


@pytest.mark.parametrize(
    ("length", "number", "met"),
    [
        (100, 4, False),  # 5 in all
        (100, 5, True),
        (1000, 5, True),
        (1001, 5, False),  # 5.005 counts up
        (1001, 6, True),
        (1400, 7, True),  # 1.4 · 5 is 7 and a rounding of the double
        (2000, 9, False),
        (2000, 10, True),
    ],
)
def test_five_positions_per_metre_and_five_in_all(length: float, number: int, met: bool) -> None:
    found = positions_per_metre(evenly(0, length, number), 5, Basis.PUBLISHED, minimum=5)

    assert found.met is met


@pytest.mark.parametrize(("length", "number", "met"), [(1000, 10, False), (1000, 11, True), (700, 8, True)])
def test_ten_positions_per_metre_and_one_more(length: float, number: int, met: bool) -> None:
    found = positions_per_metre(evenly(0, length, number), 10, Basis.PUBLISHED, further=1)

    assert found.met is met


def test_positions_per_metre_say_what_they_ask_for_and_what_there_is() -> None:
    found = positions_per_metre(evenly(-50, 250, 9), 10, Basis.PUBLISHED, further=1, minimum=5)

    assert said(found) == (
        "At least 10 positions per metre and 1 more, 5 in all",
        "9 positions on 300 mm",
        True,
    )


def test_positions_per_metre_are_open_beyond_the_length_for_which_they_are_stated() -> None:
    found = positions_per_metre(evenly(0, 2500, 40), 10, Basis.PUBLISHED, further=1)

    assert said(found)[1:] == ("40 positions on 2500 mm; the rule is stated up to 2000 mm", None)


def test_positions_per_metre_are_open_on_a_rotary_axis() -> None:
    found = positions_per_metre(rotary(0, 120, 240), 10, Basis.PUBLISHED)

    assert said(found)[1:] == ("3 positions; the rule is stated for lengths only", None)


def scale_of(element: float, travel: tuple[float, float] | None = None) -> Axis:
    return Axis("X", travel=travel, scale_element=element)


@pytest.mark.parametrize(
    ("targets", "minimum", "met"),
    [
        ([50, 150, 250, 350], 1, True),
        ([50, 150, 350], 1, False),  # none between 200 and 300 mm
        ([0, 100, 200, 300, 400], 2, True),  # a target at a joint belongs to both elements
        ([50, 150, 250, 350], 2, False),
    ],
)
def test_each_scale_element_of_the_travel_holds_its_positions(
    targets: list[float], minimum: int, met: bool
) -> None:
    axis = scale_of(0.1, travel=(0.0, 0.4))
    found = positions_per_scale_element(measured_at(*targets, axis=axis), minimum, Basis.PUBLISHED)

    assert found.met is met


def test_scale_elements_count_from_the_first_target_where_no_travel_is_stated() -> None:
    measurements = measured_at(10, 60, 110, 160, axis=scale_of(0.1))

    assert said(positions_per_scale_element(measurements, 3, Basis.PUBLISHED)) == (
        "At least 3 positions on each scale element",
        "3 positions on the element of 100 mm that has fewest",
        True,
    )


def test_targets_of_one_random_fraction_on_each_element_satisfy_one_for_each() -> None:
    measurements = measured_at(3, 195, 201, 399, axis=scale_of(0.1, travel=(0.0, 0.4)))
    one_in_each = measured_at(3, 195, 201, 301, axis=scale_of(0.1, travel=(0.0, 0.4)))

    assert positions_per_scale_element(measurements, 1, Basis.PUBLISHED).met is True
    assert positions_per_scale_element(one_in_each, 2, Basis.PUBLISHED).met is False


def test_a_scale_without_stated_elements_is_one_piece_and_says_so() -> None:
    found = positions_per_scale_element(measured_at(0, 100), 2, Basis.PUBLISHED)

    assert said(found)[1:] == ("2 positions; scale taken as one piece, no element stated", True)


@pytest.mark.parametrize(
    ("angle", "number", "met"),
    [
        (90, 2, False),
        (90, 3, True),
        (91, 3, False),
        (180, 4, False),
        (180, 5, True),
        (360, 7, False),
        (360, 8, True),
    ],
)
def test_positions_by_angle(angle: float, number: int, met: bool) -> None:
    measurements = rotary(*np.linspace(0, angle, number))

    assert positions_by_angle(measurements, BY_ANGLE, 8, Basis.APPLIED).met is met


@pytest.mark.parametrize(
    ("targets", "found", "met"),
    [
        ([0, 45, 90, 135, 180, 225, 270, 315], "they are", True),
        ([0, 50, 90, 180, 250, 310, 360], "lacking: 270°", False),
        ([-90, 0, 90], "they are", True),
        ([-100, 10, 100], "lacking: 0°, 90°, 270°", False),
        ([10, 40, 80], "they are", True),  # none of them lies in the measured angle
        ([0, 90, 180, 270, 330, 360.001], "they are", True),  # 360° is 0° again
    ],
)
def test_principal_angles_are_among_the_targets(targets: list[float], found: str, met: bool) -> None:
    assert said(principal_angles(rotary(*targets), Basis.APPLIED))[1:] == (found, met)


@pytest.mark.parametrize(
    ("travel", "met"),
    [((-0.01, 0.11), True), ((0.11, -0.01), True), ((-0.05, 0.15), True), ((-0.06, 0.1), False)],
)
def test_targets_are_spread_when_no_more_is_left_at_an_end_than_between_two(
    travel: tuple[float, float], met: bool
) -> None:
    measurements = measured_at(0, 50, 100, axis=Axis("X", travel=travel))

    assert positions_over_travel(measurements).met is met


def test_the_spread_over_the_travel_is_open_where_no_travel_is_stated() -> None:
    assert said(positions_over_travel(measured_at(0, 50, 100)))[1:] == (
        "0 mm to 100 mm; travel not stated",
        None,
    )


def test_a_length_exceeds_a_limit_by_more_than_the_rounding_of_its_digits() -> None:
    assert not exceeds(2.1 - 0.1, 2.0)
    assert not exceeds(2.3 - 0.3, 2.0)
    assert exceeds(2.000001, 2.0)


def with_missing(*places: tuple[int, int, int]) -> MeasurementSet:
    grid = np.zeros((2, 3, 5))
    for place in places:
        grid[place] = np.nan
    return bidirectional_test([0, 100, 200], grid[0], grid[1])


def test_both_directions_are_asked_for() -> None:
    found = both_directions(simulated_test(), CONSEQUENCE, Basis.PUBLISHED)

    assert said(found)[1:] == ("both directions", True)


@pytest.mark.parametrize(
    ("approach", "words"),
    [
        (Approach.POSITIVE, "positive direction only; no reversal"),
        (Approach.NEGATIVE, "negative direction only; no reversal"),
    ],
)
def test_a_test_in_one_direction_falls_short_with_its_consequence(approach: Approach, words: str) -> None:
    found = both_directions(simulated_test(approaches=[approach]), CONSEQUENCE, Basis.PUBLISHED)

    assert said(found)[1:] == (words, False)


def test_a_direction_that_is_named_without_a_reading_was_not_measured() -> None:
    named = with_missing(*((1, target, run) for target in range(3) for run in range(5)))

    assert named.approaches == (Approach.POSITIVE, Approach.NEGATIVE)
    assert measured_approaches(named) == (Approach.POSITIVE,)
    assert both_directions(named, CONSEQUENCE, Basis.PUBLISHED).met is False


@pytest.mark.parametrize(("runs", "met"), [(4, False), (5, True), (10, True)])
def test_runs_are_counted(runs: int, met: bool) -> None:
    found = number_of_runs(simulated_test(runs=runs), 5, Basis.APPLIED)

    assert said(found) == ("At least 5 runs in each direction", f"{runs} runs", met)


def test_the_direction_with_fewer_runs_counts() -> None:
    lacking = with_missing(*((1, target, 4) for target in range(3)))

    assert fewest_runs(lacking) == 4


def test_a_missing_reading_at_one_target_leaves_the_run_a_run() -> None:
    assert fewest_runs(with_missing((1, 2, 4))) == 5


def test_a_full_test_misses_nothing() -> None:
    assert said(no_missing_readings(with_missing()))[1:] == ("all 30 readings", True)


def test_missing_readings_are_counted_with_n_by_position() -> None:
    found = no_missing_readings(with_missing((0, 1, 0), (0, 1, 3), (1, 2, 2)))

    assert said(found)[1:] == ("3 of 30 missing; n from 3 to 5, evaluated by what is there", False)


@pytest.mark.parametrize(
    ("words", "english", "german"),
    [
        (position_in_words(LINEAR, 0.0125), "12.5 mm", "12,5 mm"),
        (position_in_words(LINEAR, 2.5431875), "2543.1875 mm", "2543,1875 mm"),
        (position_in_words(ROTARY, math.pi / 2), "90°", "90°"),
        (deviation_in_words(LINEAR, -1.5e-6), "−1.5 µm", "−1,5 µm"),
        (deviation_in_words(ROTARY, math.radians(2.5 / 3600)), "2.5″", "2,5″"),
        (positions_in_words(1), "1 position", "1 Position"),
        (positions_in_words(21), "21 positions", "21 Positionen"),
        (runs_in_words(1), "1 run", "1 Durchlauf"),
        (runs_in_words(5), "5 runs", "5 Durchläufe"),
    ],
)
def test_values_are_written_in_the_units_and_manner_of_the_page(
    words: Words, english: str, german: str
) -> None:
    assert words.in_language(Language.ENGLISH) == english
    assert words.in_language(Language.GERMAN) == german


def taken_at(*targets: float, pitch: float | None = None, signal: float | None = None) -> MeasurementSet:
    readings = np.zeros((len(targets), 1))
    axis = Axis("X", screw_pitch=pitch, signal_period=signal)
    return bidirectional_test(targets, readings, readings, axis=axis)


@pytest.mark.parametrize(
    ("targets", "met"),
    [
        ([0, 50, 100, 150], False),  # 5 pitches each
        ([3, 53, 103, 153], False),  # the same phase, though not zero
        ([0, 30, 100, 110], False),  # uneven, and yet at one phase
        ([0, 52, 104, 156], True),
        ([0, 50.3, 100.1, 149.6], True),
    ],
)
def test_spacing_of_whole_pitches_hides_the_deviation_of_the_pitch(targets: list[float], met: bool) -> None:
    (found,) = spacing_against_periods(taken_at(*targets, pitch=0.01), Basis.APPLIED)

    assert said(found)[0] == "Spacing no integer multiple of the pitch (10 mm)"
    assert found.met is met
    assert (said(found)[1] == HIDDEN) is not met


def test_each_stated_period_is_held_against_the_spacing() -> None:
    pitch, signal = spacing_against_periods(
        taken_at(0, 25.01, 50.02, 75.03, pitch=0.01, signal=20e-6), Basis.APPLIED
    )

    assert (said(pitch)[0], pitch.met) == ("Spacing no integer multiple of the pitch (10 mm)", True)
    assert (said(signal)[0], signal.met) == (
        "Spacing no integer multiple of the signal period (0.02 mm)",
        True,
    )


def test_rounding_of_decimal_positions_does_not_pass_for_another_phase() -> None:
    (found,) = spacing_against_periods(
        taken_at(0.1, 200.1, 700.1, 1100.1, 1999.7, signal=20e-6), Basis.APPLIED
    )

    assert found.met is False


def test_spacing_is_open_where_no_period_is_stated() -> None:
    (found,) = spacing_against_periods(taken_at(0, 50, 100), Basis.APPLIED)

    assert said(found)[1:] == ("no period stated", None)


def test_spacing_is_open_at_a_single_position() -> None:
    (found,) = spacing_against_periods(taken_at(50, pitch=0.01), Basis.APPLIED)

    assert found.met is None


def test_equal_intervals_carry_no_random_fraction() -> None:
    found = random_fractions(taken_at(0.3, 10.5, 20.7, 30.9), FORMULA, Basis.PUBLISHED)

    assert said(found) == (
        "Targets P = N·p + r with a random fraction r at each",
        "all intervals alike: 10.2 mm",
        False,
    )


@pytest.mark.parametrize(("interval", "words"), [(45.0, "45°"), (30.0, "30°"), (0.1, "0.1°")])
def test_equal_intervals_of_a_rotary_axis_are_named_in_round_degrees(interval: float, words: str) -> None:
    turned = rotary(*(interval * number for number in range(4)))

    assert said(random_fractions(turned, FORMULA, Basis.PUBLISHED))[1] == f"all intervals alike: {words}"


def test_a_mean_interval_of_a_rotary_axis_is_named_in_round_degrees() -> None:
    found = mean_interval(rotary(0, 40, 100, 135), math.radians(45), Basis.PUBLISHED)

    assert said(found)[1:] == ("45°", True)


def test_differing_intervals_can_carry_a_random_fraction() -> None:
    found = random_fractions(taken_at(0, 10.21, 19.87, 30.4), FORMULA, Basis.PUBLISHED)

    assert said(found)[1:] == ("intervals from 9.66 mm to 10.53 mm", True)


def test_one_interval_of_three_times_the_others_is_no_interval_with_fractions() -> None:
    found = random_fractions(taken_at(0, 10.21, 19.87, 30.4, 904), FORMULA, Basis.PUBLISHED)

    assert found.met is False
    assert (
        found.found.in_language(Language.ENGLISH)
        == "intervals from 9.66 mm to 873.6 mm: there is no interval p"
    )


@pytest.mark.parametrize(("targets", "met"), [([0, 10], None), ([0, 10, 20.3], True)])
def test_two_positions_do_not_tell_whether_there_is_a_random_fraction_and_three_do(
    targets: list[float], met: bool | None
) -> None:
    assert random_fractions(taken_at(*targets), FORMULA, Basis.PUBLISHED).met is met


@pytest.mark.parametrize(("number", "met"), [(13, True), (12, False)])
def test_mean_interval(number: int, met: bool) -> None:
    measurements = taken_at(*np.linspace(0, 3000, number))

    assert mean_interval(measurements, 0.25, Basis.APPLIED).met is met


@pytest.mark.parametrize(("length", "met"), [(0.25, True), (0.4, False)])
def test_two_targets_have_one_interval(length: float, met: bool) -> None:
    assert mean_interval(taken_at(0.0, 1000 * length), 0.25, Basis.APPLIED).met is met


#: Five positions on 200 mm of an axis of 300 mm, once in each direction.
FEW = evenly(0, 200, 5, axis=Axis("X", travel=(0.0, 0.3)))


@pytest.mark.parametrize(
    ("finding", "asked", "found"),
    [
        (
            positions_per_metre(FEW, 5, Basis.APPLIED),
            "Mindestens 5 Positionen je Meter",
            "5 Positionen auf 200 mm",
        ),
        (positions_in_all(FEW, 11, Basis.APPLIED), "Mindestens 11 Positionen", "5 Positionen"),
        (
            positions_over_travel(FEW),
            "Sollpositionen über den ganzen Verfahrbereich verteilt",
            "0 mm bis 200 mm von 0 mm bis 300 mm",
        ),
        (
            both_directions(FEW, CONSEQUENCE, Basis.APPLIED),
            "Anfahren der Sollpositionen in positiver und in negativer Richtung",
            "beide Richtungen",
        ),
        (
            number_of_runs(FEW, 5, Basis.APPLIED),
            "Mindestens 5 Durchläufe je Richtung",
            "1 Durchlauf",
        ),
        (no_missing_readings(FEW), "Ein Messwert je Sollposition und Durchlauf", "alle 10 Messwerte"),
        (
            random_fractions(FEW, FORMULA, Basis.APPLIED),
            "Sollpositionen P = N·p + r mit zufälligem Anteil r",
            "alle Abstände gleich: 50 mm",
        ),
        (
            positions_by_angle(rotary(0, 90, 180), BY_ANGLE, 2, Basis.APPLIED),
            "Mindestens 5 Positionen auf 180°",
            "3 Positionen",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_how_a_requirement_reads_in_german(finding: Finding, asked: str, found: str) -> None:
    german = Language.GERMAN
    assert (finding.requirement.in_language(german), finding.found.in_language(german)) == (asked, found)


def test_runs_are_counted_in_german() -> None:
    assert [runs_in_words(number).in_language(Language.GERMAN) for number in (1, 2)] == [
        "1 Durchlauf",
        "2 Durchläufe",
    ]


def test_a_mean_interval_has_no_digits_that_nobody_stated() -> None:
    measurements = measured_at(0, 50.0001, 70, 100)
    assert (
        mean_interval(measurements, 0.25, Basis.APPLIED).found.in_language(Language.ENGLISH) == "33.3333 mm"
    )
