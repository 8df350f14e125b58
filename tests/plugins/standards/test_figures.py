"""The prescribed graphs: what they show, at which targets, and how long brackets and arrows are."""

from __future__ import annotations

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS, evaluated
from zlmreport.plugin import Approach, Axis, AxisKind, Figure, Language, MeasurementSet
from zlmreport.plugin.standard import Arrow, Bracket, Panel, Role
from zlmreport.testing import bidirectional_test, simulated_test

ISO = [identifier for identifier in STANDARDS if identifier.startswith("iso230-2")]
SINCE_1997 = ISO[1:]
VDI = ["vdi-dgq-3441", "vdi-vde-2617"]

#: Deviations in µm whose extremes are known: the negative direction lies below, but for 300 mm.
TARGETS = [0, 100, 200, 300]
UP = [[1.0, 3.0], [10.0, 12.0], [-4.0, -4.0], [5.0, 7.0]]
DOWN = [[0.0, 0.0], [1.0, 1.0], [-9.0, -5.0], [8.0, 8.0]]
TEST = bidirectional_test(TARGETS, UP, DOWN)
ONE_RUN = simulated_test(runs=1)
UPWARDS = simulated_test(approaches=[Approach.POSITIVE])
ONE_RUN_UPWARDS = simulated_test(runs=1, approaches=[Approach.POSITIVE])
DOWNWARDS = simulated_test(approaches=[Approach.NEGATIVE])
ROOT_2 = np.sqrt(2)  # s of two readings that differ by 2


def figures(identifier: str, measurements: MeasurementSet = TEST) -> dict[str, Figure]:
    standard = STANDARDS[identifier]
    evaluation = evaluated(identifier, measurements)
    return {figure.key: figure for figure in standard.figures(evaluation, standard.options())}


def panel(identifier: str, key: str, measurements: MeasurementSet = TEST, number: int = 0) -> Panel:
    return figures(identifier, measurements)[key].panels[number]


def arrows(shown: Panel) -> dict[str, Arrow]:
    return {arrow.notation: arrow for arrow in shown.arrows}


def brackets(shown: Panel) -> dict[str, Bracket]:
    return {bracket.notation: bracket for bracket in shown.brackets}


def ends(bracket: Bracket) -> tuple[float, float, float, float]:
    return bracket.low, bracket.low_at, bracket.high, bracket.high_at


@pytest.mark.parametrize("identifier", STANDARDS)
def test_each_standard_has_its_pair_of_diagrams(identifier: str) -> None:
    pair = ["means", "overall"]
    expected = [*pair, "unidirectional"] if identifier in ISO else pair

    assert list(figures(identifier)) == expected


@pytest.mark.parametrize("identifier", STANDARDS)
def test_all_single_readings_stand_behind_the_means(identifier: str) -> None:
    shown = panel(identifier, "means").readings

    assert [each.approach for each in shown] == [Approach.POSITIVE, Approach.NEGATIVE]
    assert sorted(shown[0].y.tolist()) == pytest.approx(sorted(np.ravel(UP)))
    assert sorted(set(shown[1].x.tolist())) == pytest.approx(TARGETS)


@pytest.mark.parametrize("identifier", STANDARDS)
def test_graphs_are_in_the_units_of_the_page(identifier: str) -> None:
    rotary = simulated_test(9, axis=Axis("C", AxisKind.ROTARY), length=360)

    linear_graph, rotary_graph = figures(identifier)["means"], figures(identifier, rotary)["means"]

    assert (linear_graph.x_unit, linear_graph.y_unit) == ("mm", "µm")
    assert (rotary_graph.x_unit, rotary_graph.y_unit) == ("°", "″")
    assert rotary_graph.panels[0].curves[0].x[-1] == pytest.approx(360)


@pytest.mark.parametrize("edition", SINCE_1997)
def test_iso_brackets_lead_to_the_points_at_which_extremes_arise(edition: str) -> None:
    found = brackets(panel(edition, "overall"))

    assert ends(found["A"]) == pytest.approx((-7 - 4 * ROOT_2, 200, 11 + 2 * ROOT_2, 100))
    assert ends(found["E"]) == pytest.approx((-7, 200, 11, 100))
    assert ends(found["M"]) == pytest.approx((-5.5, 200, 7, 300))


def test_iso_1988_brackets_three_standard_deviations_and_has_neither_e_nor_m() -> None:
    found = brackets(panel("iso230-2:1988", "overall"))

    assert list(found) == ["A"]
    assert ends(found["A"]) == pytest.approx((-7 - 6 * ROOT_2, 200, 11 + 3 * ROOT_2, 100))


@pytest.mark.parametrize(
    ("edition", "index", "k"), [("iso230-2:1988", "_{j}", 3), *((each, "_{i}", 2) for each in SINCE_1997)]
)
def test_iso_arrows_stand_where_reversal_and_repeatability_are_largest(
    edition: str, index: str, k: int
) -> None:
    found = arrows(panel(edition, "means"))
    reversal, repeatability = found[f"B{index}"], found[f"R{index}"]

    # |B| is 2, 10, 3, 2 µm; R_i is 10 + k·√2 at 100 mm and 3 + 2k·√2 or the two-sided 4k·√2 at 200 mm.
    assert (reversal.x, reversal.low, reversal.high) == pytest.approx((100, 1, 11))
    expected = {
        2: (100, 1, 11 + 2 * ROOT_2),
        3: (200, -7 - 6 * ROOT_2, -7 + 6 * ROOT_2),
    }
    assert (repeatability.x, repeatability.low, repeatability.high) == pytest.approx(expected[k])


@pytest.mark.parametrize("edition", ISO)
def test_iso_arrows_are_as_long_as_r_and_b(edition: str) -> None:
    measurements = simulated_test()
    found, evaluation = arrows(panel(edition, "overall", measurements)), evaluated(edition, measurements)
    unit = measurements.axis.deviation_unit

    for symbol in ("R", "B"):
        value = evaluation.value(symbol)
        assert found[symbol].high - found[symbol].low == pytest.approx(unit.from_si(value), rel=1e-9)


@pytest.mark.parametrize("edition", SINCE_1997)
def test_iso_shows_each_direction_in_a_panel_with_its_own_parameters(edition: str) -> None:
    up, down = figures(edition)["unidirectional"].panels

    assert (list(brackets(up)), list(arrows(up))) == (["A↑", "E↑"], ["R↑"])
    assert (list(brackets(down)), list(arrows(down))) == (["A↓", "E↓"], ["R↓"])
    assert ends(brackets(up)["E↑"]) == pytest.approx((-4, 200, 11, 100))
    assert ends(brackets(down)["A↓"]) == pytest.approx((-7 - 4 * ROOT_2, 200, 8, 300))
    assert arrows(down)["R↓"].x == pytest.approx(200)
    assert [each.approach for each in up.readings] == [Approach.POSITIVE]
    assert up.heading is not None


def test_iso_1988_has_no_systematic_deviation_in_one_direction() -> None:
    up, down = figures("iso230-2:1988")["unidirectional"].panels

    assert (list(brackets(up)), list(brackets(down))) == (["A↑"], ["A↓"])


def test_iso_curves_and_limits_carry_the_letters_and_factor_of_the_edition() -> None:
    old, new = panel("iso230-2:1988", "means"), panel("iso230-2:2014", "means")

    assert [each.notation for each in old.curves] == ["x̄_{j}↑", "x̄_{j}↓", "x̄_{j}"]
    assert [each.notation for each in new.curves] == ["x̄_{i}↑", "x̄_{i}↓", "x̄_{i}"]
    assert old.bands[0].notation == "x̄_{j}↑ ± 3s_{j}↑"
    assert new.bands[1].notation == "x̄_{i}↓ ± 2s_{i}↓"


@pytest.mark.parametrize(("identifier", "k"), [("vdi-dgq-3441", 3), ("vdi-vde-2617", 2)])
def test_vdi_limits_lie_half_of_reversal_and_spread_about_the_mean_whichever_direction_is_above(
    identifier: str, k: int
) -> None:
    spread = next(each for each in panel(identifier, "means").bands if each.role is Role.SPREAD)

    # At 300 mm the negative direction lies above: means 6 and 8, s √2 and 0.
    assert spread.upper[3] == pytest.approx(7 + (2 + k * ROOT_2) / 2)
    assert spread.lower[3] == pytest.approx(7 - (2 + k * ROOT_2) / 2)


@pytest.mark.parametrize(("identifier", "k"), [("vdi-dgq-3441", 3), ("vdi-vde-2617", 2)])
def test_vdi_arrows_stand_on_each_other_where_the_band_is_widest(identifier: str, k: int) -> None:
    found = arrows(panel(identifier, "means"))
    reversal, spread = found["U_{j}/2"], found["P_{sj}/2"]

    # U + Ps is 10 + k·√2 at 100 mm and 3 + 2k·√2 at 200 mm.
    assert (reversal.x, reversal.low, reversal.high) == pytest.approx((100, 6, 11))
    assert (spread.x, spread.low, spread.high) == pytest.approx((100, 11, 11 + k * ROOT_2 / 2))


@pytest.mark.parametrize(("identifier", "k"), [("vdi-dgq-3441", 3), ("vdi-vde-2617", 2)])
def test_vdi_brackets_p_pa_and_the_largest_reversal(identifier: str, k: int) -> None:
    found = brackets(panel(identifier, "overall"))

    assert ends(found["P"]) == pytest.approx(
        (-5.5 - (3 + 2 * k * ROOT_2) / 2, 200, 6 + (10 + k * ROOT_2) / 2, 100)
    )
    assert ends(found["P_{a}"]) == pytest.approx((-5.5, 200, 7, 300))
    assert ends(found["U_{max}"]) == pytest.approx((1, 100, 11, 100))


def test_nmtba_arrow_is_half_the_largest_spread() -> None:
    found = arrows(panel("nmtba", "means"))["P_{sj}/2"]

    # At 100 mm: 10, 12, 1, 1 about 6; squares 16 + 36 + 25 + 25 on 3 degrees of freedom.
    assert (found.x, found.low, found.high) == pytest.approx((100, 6, 6 + 3 * np.sqrt(102 / 3)))


def test_nmtba_shows_its_offset_as_an_arrow_from_zero_to_the_middle_of_the_band() -> None:
    shown = panel("nmtba", "overall")
    (middle,) = [level.y for level in shown.levels]
    offset = evaluated("nmtba", TEST).value("O")

    assert middle == pytest.approx((brackets(shown)["P"].low + brackets(shown)["P"].high) / 2)
    assert middle == pytest.approx(-1e6 * offset)
    assert sorted((arrows(shown)["O"].low, arrows(shown)["O"].high)) == pytest.approx(sorted((0.0, middle)))


@pytest.mark.parametrize("edition", SINCE_1997)
def test_one_run_shows_systematic_deviation_and_reversal_and_no_limits(edition: str) -> None:
    shown = panel(edition, "overall", ONE_RUN)

    assert shown.bands == ()
    assert list(brackets(shown)) == ["E", "M"]
    assert list(arrows(shown)) == ["B"]


@pytest.mark.parametrize("identifier", VDI)
def test_one_run_of_vdi_shows_mean_and_reversal(identifier: str) -> None:
    means, overall = panel(identifier, "means", ONE_RUN), panel(identifier, "overall", ONE_RUN)

    assert [each.role for each in means.bands] == [Role.REVERSAL]
    assert list(arrows(means)) == ["U_{j}/2"]
    assert list(brackets(overall)) == ["P_{a}", "U_{max}"]


@pytest.mark.parametrize(
    ("measurements", "arrow", "role"),
    [(UPWARDS, "↑", Role.MEAN_POSITIVE), (DOWNWARDS, "↓", Role.MEAN_NEGATIVE)],
    ids=["upwards", "downwards"],
)
def test_iso_in_one_direction_shows_that_direction(
    measurements: MeasurementSet, arrow: str, role: Role
) -> None:
    found = figures("iso230-2:2014", measurements)

    assert list(found) == ["means", "unidirectional"]
    assert [each.role for each in found["means"].panels[0].curves] == [role]
    assert found["means"].panels[0].arrows == ()
    (only,) = found["unidirectional"].panels
    assert list(brackets(only)) == [f"A{arrow}", f"E{arrow}"]


@pytest.mark.parametrize("identifier", [*VDI, "nmtba"])
def test_vdi_and_nmtba_in_one_direction_show_that_direction(identifier: str) -> None:
    means, overall = panel(identifier, "means", DOWNWARDS), panel(identifier, "overall", DOWNWARDS)

    assert [each.role for each in means.curves] == [Role.MEAN_NEGATIVE]
    assert list(arrows(means)) == ["P_{sj}/2"]
    assert list(brackets(overall)) == ["P", "P_{a}"]


@pytest.mark.parametrize("identifier", STANDARDS)
def test_a_missing_direction_at_a_target_leaves_a_gap(identifier: str) -> None:
    down = [*DOWN[:1], [np.nan, np.nan], *DOWN[2:]]
    shown = panel(identifier, "means", bidirectional_test(TARGETS, UP, down))
    both = next(each for each in shown.curves if each.role is Role.MEAN_BIDIRECTIONAL)

    assert np.isnan(both.y).tolist() == [False, True, False, False]


@pytest.mark.parametrize(
    ("language", "said"),
    [
        (Language.ENGLISH, ["Axis X", "4 positions", "0 mm to 300 mm", "B = 10 µm at 100 mm", "E = 18 µm"]),
        (
            Language.GERMAN,
            ["Achse X", "4 Positionen", "0 mm bis 300 mm", "B = 10 µm bei 100 mm", "E = 18 µm"],
        ),
    ],
)
def test_alternative_text_tells_values_and_places(language: Language, said: list[str]) -> None:
    overall = figures("iso230-2:2014")["overall"]
    text = f"{overall.title.in_language(language)} {overall.alternative.in_language(language)}"

    assert [part for part in said if part not in text] == []


def test_alternative_text_of_the_offset_keeps_its_sign() -> None:
    test = bidirectional_test([0, 100], [[1.0, 3.0], [1.0, 3.0]], [[1.0, 3.0], [1.0, 3.0]])
    text = figures("nmtba", test)["overall"].alternative.in_language(Language.ENGLISH)

    assert "The band's middle lies at 2 µm, so that O = −2 µm." in text


@pytest.mark.parametrize("identifier", STANDARDS)
def test_titles_name_the_axis_as_the_user_typed_it(identifier: str) -> None:
    test = simulated_test(axis=Axis("{X}"))

    assert all(
        "Achse {X}:" in figure.title.in_language(Language.GERMAN)
        for figure in figures(identifier, test).values()
    )


@pytest.mark.parametrize(
    ("measurements", "shown"),
    [
        (TEST, "limits at 2 standard deviations, largest reversal and repeatability"),
        (UPWARDS, "limits at 2 standard deviations"),
        (ONE_RUN, "largest reversal"),
        (ONE_RUN_UPWARDS, ""),
    ],
    ids=["whole", "one direction", "one run", "one reading"],
)
def test_the_caption_of_the_means_names_what_they_show(measurements: MeasurementSet, shown: str) -> None:
    figure = figures("iso230-2:2014", measurements)["means"]
    said = ", ".join(filter(None, ("mean deviations", shown)))
    assert figure.title.in_language(Language.ENGLISH).endswith(f": {said}")
    drawn = {each.notation for each in figure.panels[0].arrows}
    assert ("B_{i}" in drawn) == ("reversal" in shown)
    assert ("R_{i}" in drawn) == ("repeatability" in shown)


@pytest.mark.parametrize(
    ("identifier", "key", "measurements", "said"),
    [
        ("vdi-dgq-3441", "means", ONE_RUN, "mean deviations and reversal span"),
        ("vdi-dgq-3441", "overall", ONE_RUN, "position deviation and reversal span where they arise"),
        ("vdi-vde-2617", "overall", ONE_RUN_UPWARDS, "position deviation where it arises"),
        ("vdi-vde-2617", "overall", UPWARDS, "position uncertainty and position deviation where they arise"),
        ("iso230-2:1988", "unidirectional", ONE_RUN, "mean deviations by direction"),
        ("iso230-2:2014", "unidirectional", ONE_RUN, "unidirectional parameters and where they arise"),
    ],
)
def test_a_caption_names_no_parameter_that_a_single_run_does_not_define(
    identifier: str, key: str, measurements: MeasurementSet, said: str
) -> None:
    figure = figures(identifier, measurements)[key]
    assert figure.title.in_language(Language.ENGLISH).endswith(f": {said}")
