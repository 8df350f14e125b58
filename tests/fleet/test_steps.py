"""Steps are seen at once, told from drifts, and seldom seen where there is none."""

from __future__ import annotations

import math
import random
from statistics import NormalDist

import numpy as np
import pytest

from fleet.histories import entry, history, judged, parameter, quarters
from zlmreport.fleet.causes import Cause, Shared, find_cause_of, find_shared
from zlmreport.fleet.drifts import Trend, judge_trends
from zlmreport.fleet.records import MODEL, LedgerEntry
from zlmreport.fleet.scatter import ScatterLikelihood, learn_scatter
from zlmreport.fleet.steps import compute_chances, compute_level_of, judge_course, sum_squares_about_mean
from zlmreport.fleet.trend import list_series_of, select_standing

LIMIT = 20.0
CALM = [8.0, 8.4, 8.1, 8.3, 8.2, 8.0]


def fleet_with(values: list[float], **others: list[float]) -> Trend:
    """Return what is said of an axis among calm ones."""
    names = {**{f"C{each}": [value + 0.02 * each for value in CALM] for each in range(6)}, **others}
    entries = [each for axis, calm in names.items() for each in history(calm, axis=axis)]
    found = judged([*history(values, axis="X"), *entries])
    return next(each for each in found if each.series.axis == "X")


def test_a_jump_is_seen_at_once_and_has_its_size_and_date() -> None:
    trend = fleet_with([3.9, 3.6, 3.8, 3.9, 12.8])
    assert trend.step
    assert trend.step.index == 4
    assert trend.step.change == pytest.approx(9.0)
    assert trend.step.probability > 0.9
    assert not trend.drifts


def test_a_jump_of_the_only_axis_of_a_fleet_is_seen_too() -> None:
    (trend,) = judged(history([3.9, 3.6, 3.8, 3.9, 12.8]))
    assert trend.step


@pytest.mark.parametrize(
    ("limits", "shares"),
    [
        ([20.0], [1.0]),
        ([20.0, 20.0], [0.5, 0.5]),
        ([20.0, None], [1.0, None]),
        ([None, None], [1.0, None]),
    ],
)
def test_parameters_with_a_limit_share_the_chance_of_a_false_alarm_of_their_axis(
    limits: list[float | None], shares: list[float | None]
) -> None:
    entries = [
        entry(day, *(parameter(8.0, symbol=f"A{at}", limit=limit) for at, limit in enumerate(limits)))
        for day in quarters(5)
    ]
    assert [each.course.share if each.course else None for each in judged(entries)] == shares


def test_what_came_before_a_step_that_was_borne_out_is_no_part_of_a_drift() -> None:
    trend = fleet_with([3.9, 3.6, 3.8, 3.9, 12.8, 12.6, 12.9, 12.7, 12.8])
    assert trend.course
    assert [each.index for each in trend.course.steps] == [4]
    assert trend.step is None
    assert trend.since == quarters(9)[4]
    assert not trend.drifts


def test_an_odd_test_that_the_next_does_not_bear_out_is_no_step() -> None:
    trend = fleet_with([3.9, 3.6, 3.8, 3.9, 12.8, 3.8, 3.7])
    assert trend.course
    assert trend.course.steps == ()
    assert 4 not in trend.course.since


def test_a_change_that_is_small_against_the_limit_is_no_news() -> None:
    assert fleet_with([3.8, 3.9, 3.7, 3.8, 6.8]).step is None
    assert fleet_with([3.8, 3.9, 3.7, 3.8, 7.8]).step


def test_a_drift_that_is_small_against_the_limit_is_no_news() -> None:
    steady = [8.0 + 0.03 * quarter for quarter in range(9)]  # 0.12 µm a year
    assert not fleet_with(steady).drifts
    assert fleet_with([8.0 + 0.3 * quarter for quarter in range(9)]).drifts


def test_a_drift_is_no_step() -> None:
    trend = fleet_with([8.0 + 1.0 * quarter + wave for quarter, wave in enumerate((0.1, -0.1) * 4)])
    assert trend.drifts
    assert trend.step is None
    assert trend.probability > 0.9


def test_a_step_too_small_to_be_seen_at_once_is_no_drift_later() -> None:
    rng = np.random.default_rng(3)
    others = {f"Q{each}": rng.normal(10, 1, 10).tolist() for each in range(60)}
    values = [9.6, 10.3, 9.9, 10.4, 9.8, 12.4, 12.6, 12.2, 12.7, 12.3]
    trend = fleet_with(values, **others)
    assert not trend.drifts
    if trend.step:
        assert trend.step.index == 5


def test_tests_that_scatter_more_than_before_are_told() -> None:
    trend = fleet_with([8.0, 8.1, 8.0, 8.1, 8.0, 9.6, 6.6, 10.4, 5.4])
    assert trend.is_wilder or trend.step


def test_an_axis_says_which_step_it_would_show() -> None:
    trend = fleet_with(CALM)
    assert trend.smallest == pytest.approx(0.2 * LIMIT, rel=0.02)
    (alone,) = judged(history([8.0, 9.5, 7.0]))
    assert alone.smallest
    assert alone.smallest > LIMIT


def test_the_effect_and_the_instrument_that_changed_with_it_are_named() -> None:
    days = quarters(5)
    values, lost, scale = [3.9, 3.6, 3.8, 3.9, 12.8], [1.0, 1.1, 0.9, 1.0, 5.2], [2.0, 2.1, 1.9, 2.0, 2.1]
    entries = [
        entry(
            day,
            parameter(a),
            parameter(b, standard=MODEL, symbol="backlash.lost_motion", expanded_uncertainty=0.3, limit=None),
            parameter(c, standard=MODEL, symbol="scale-error.slope", expanded_uncertainty=0.3, limit=None),
            instrument="Laser A" if day < days[4] else "Laser B",
        )
        for day, a, b, c in zip(days, values, lost, scale, strict=True)
    ]
    series = list_series_of(select_standing(entries))
    (trend,) = judge_trends(each for each in series if each.standard != MODEL)
    cause = find_cause_of(trend, [each for each in series if each.standard == MODEL])
    assert cause
    assert cause.change == pytest.approx(4.2)
    assert cause == Cause(
        days[4], "backlash", "lost_motion", cause.change, "um", before="Laser A", after="Laser B"
    )


def of_type(
    values: list[float], kind: str = "Works MC 800", symbol: str = "backlash.lost_motion"
) -> list[LedgerEntry]:
    """Return the latest test of machines of one type, each with a parameter of its error model."""
    return [
        entry(
            quarters(1)[0],
            parameter(8.0),
            parameter(value, standard=MODEL, symbol=symbol, limit=None),
            machine=f"{kind} {number}",
            type=kind,
            job=f"{kind}{symbol}{number}",
        )
        for number, value in enumerate(values)
    ]


def shared_in(*entries: LedgerEntry) -> tuple[Shared, ...]:
    return find_shared(each for each in list_series_of(select_standing(entries)) if each.standard == MODEL)


def test_what_machines_of_a_type_have_in_common_is_shown_with_its_mean() -> None:
    common = of_type([4.1, 3.8, 4.4, 4.0, 3.9])
    others = of_type([0.4, -0.3, 0.1, -0.2, 0.2], kind="Works MC 500")
    (found,) = shared_in(*common, *others, *of_type([4.0, 4.1, 4.2], kind="Works LT 200"))
    assert (found.type, found.axis, found.effect, found.name) == (
        "Works MC 800",
        "X",
        "backlash",
        "lost_motion",
    )
    assert found.mean == pytest.approx(4.04)
    # Student's t for 4 degrees of freedom, 2.776 (ISO/IEC Guide 98-3, table G.2), over the root of five.
    assert found.expanded_uncertainty == pytest.approx(2.776 * 0.2302 / math.sqrt(5), rel=1e-3)
    assert len(found.machines) == 5


def test_machines_whose_type_is_not_known_share_nothing() -> None:
    assert shared_in(*of_type([4.1, 3.8, 4.4, 4.0, 3.9], kind="")) == ()


def test_of_many_types_without_anything_in_common_hardly_one_is_named() -> None:
    rng = random.Random(1)
    named = 0
    for _ in range(20):
        entries = [
            each
            for kind in range(30)
            for each in of_type([rng.gauss(0, 2) for _ in range(6)], kind=f"Works {kind}")
        ]
        named += len(shared_in(*entries))
    assert named <= 1  # 0.2 are expected


@pytest.mark.parametrize("values", [[0.2, 0.25, 0.18, 0.6], [0.2, 0.3, 0.4, 0.5], [0.2, 0.24, 0.21, 0.22]])
def test_the_chances_are_those_of_integration_over_mean_effect_and_variance(values: list[float]) -> None:
    """By brute force: the mean flat, the effect N(0, (5σ)²), each scatter as likely as the fleet has it."""
    y, number = np.array(values), len(values)
    sigma = np.geomspace(0.01, 1.0, 40)[:, None]
    prior = sigma**-6.0 * np.exp(-6.0 * 0.004 / (2 * sigma**2))
    prior /= prior.sum()
    fleet = ScatterLikelihood(sigma[:, 0], prior[:, 0], 6)
    effects = np.linspace(-40, 40, 4001)[None, :]  # in scatters

    def evidence(shape: list[float] | None) -> float:
        wanted = effects if shape is not None else np.zeros((1, 1))
        line = np.array(shape if shape is not None else [0.0] * number)
        rest = y[:, None, None] - line[:, None, None] * (wanted * sigma)[None]
        rest = rest - rest.mean(axis=0)  # the flat mean integrates out
        likelihood = sigma ** (1.0 - number) * np.exp(-(rest**2).sum(axis=0) / (2 * sigma**2))
        if shape is None:
            return float((likelihood * prior).sum())
        weight = np.exp(-(effects**2) / 50) / math.sqrt(2 * math.pi * 25) * (effects[0, 1] - effects[0, 0])
        return float((likelihood * prior * weight).sum())

    shapes = [[0.0] * index + [1.0] * (number - index) for index in range(1, number)]
    ramp = [each / (number - 1) for each in range(number)]
    nothing = evidence(None)
    steps = [evidence(each) / nothing / (number - 1) for each in shapes]
    drift = evidence(ramp) / nothing
    total = 1 + sum(steps) + drift
    found = compute_chances(values, fleet)
    assert found.nothing == pytest.approx(1 / total, rel=2e-3)
    assert found.drift == pytest.approx(drift / total, rel=2e-3)
    assert found.steps[1:] == pytest.approx([each / total for each in steps], rel=2e-3)


@pytest.mark.parametrize("before", [4, 5, 7, 20])
def test_the_level_leaves_five_scatters_visible_where_the_scatter_is_known(before: int) -> None:
    normal = NormalDist()
    critical = normal.inv_cdf(1 - compute_level_of(before))
    assert 1 - normal.cdf(critical - 5 / math.sqrt(1 + 1 / before)) >= 0.95
    assert AXES * compute_level_of(before) <= 1


AXES, NIGHTS = 300, 10
ALIKE = np.full(AXES, 1 / 15)
HALF_QUIET = np.repeat([1 / 60, 1 / 15], AXES // 2)
TENTH_LOUD = np.where(np.arange(AXES) % 10 == 0, 1 / 15, 1 / 60)
FLEETS = pytest.mark.parametrize(
    "scatters", [ALIKE, HALF_QUIET, TENTH_LOUD], ids=["alike", "half quiet", "a tenth loud"]
)


def nights(scatters: np.ndarray, tests: int, seed: int) -> list[np.ndarray]:
    """Return the values of fleets without change, each a row for an axis."""
    rng = np.random.default_rng(seed)
    return [0.5 + scatters[:, None] * rng.standard_normal((AXES, tests)) for _ in range(NIGHTS)]


def known(values: np.ndarray) -> tuple[ScatterLikelihood, ...]:
    """Return what each axis knows from the others, before the latest test."""
    return learn_scatter((sum_squares_about_mean(row[:-1]), len(row) - 2) for row in values.tolist())


def stepping(values: np.ndarray) -> np.ndarray:
    """Return which axes show a step of the latest test."""
    found = [judge_course(row, fleet) for row, fleet in zip(values.tolist(), known(values), strict=True)]
    last = values.shape[1] - 1
    return np.array([bool(each.steps) and each.steps[-1].index == last for each in found])


def at_least(share: float, seen: np.ndarray) -> bool:
    """Whether a share is kept, two standard deviations of its count allowed."""
    return bool(seen.mean() >= share - 2 * math.sqrt(share * (1 - share) / seen.size))


@FLEETS
@pytest.mark.parametrize("tests", [5, 8])
def test_a_fleet_that_does_not_change_raises_at_most_one_false_alarm_a_night(
    scatters: np.ndarray, tests: int
) -> None:
    counts = [stepping(values).sum() for values in nights(scatters, tests, 20)]
    assert np.mean(counts) <= 1


@FLEETS
def test_a_step_of_a_third_of_the_limit_is_seen_at_once_after_four_tests(scatters: np.ndarray) -> None:
    """Of the axes that scatter by 1/15 of the limit, whatever the others do."""
    seen = []
    for values in nights(scatters, 5, 21):
        values[:, -1] += 1 / 3
        seen.append(stepping(values)[scatters > 1 / 16])
    assert at_least(0.95, np.concatenate(seen))


@pytest.mark.long
@FLEETS
def test_the_smallest_step_that_is_printed_is_seen_at_once(scatters: np.ndarray) -> None:
    """Each axis steps by what is printed for it, be it more than a third of the limit or less."""
    seen = []
    for values in nights(scatters, 5, 22):
        for row, fleet in zip(values, known(values), strict=True):
            printed = judge_course(row[:-1].tolist(), fleet).smallest
            assert printed
            row[-1] += printed
        seen.append(stepping(values))
    assert at_least(0.95, np.concatenate(seen))
