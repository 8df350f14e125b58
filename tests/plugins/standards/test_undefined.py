"""Which parameters a test defines: one direction, one run, long axes, missing readings."""

from __future__ import annotations

import numpy as np
import pytest

from plugins.standards.installed import evaluated
from zlmreport.plugin import Approach, Axis, AxisKind, Language, MeasurementSet
from zlmreport.testing import bidirectional_test, simulated_test

LONG = simulated_test(13, 1, length=3000)
TWO_TURNS = simulated_test(17, 1, axis=Axis("C", AxisKind.ROTARY), length=720)
ONE_RUN = simulated_test(runs=1)
UPWARDS = simulated_test(approaches=[Approach.POSITIVE])
DOWNWARDS = simulated_test(approaches=[Approach.NEGATIVE])
ONE_RUN_UPWARDS = simulated_test(runs=1, approaches=[Approach.POSITIVE])
SINCE_1997 = ("iso230-2:1997", "iso230-2:2006", "iso230-2:2014")


def defined(identifier: str, measurements: MeasurementSet) -> str:
    return " ".join(each.quantity.symbol for each in evaluated(identifier, measurements).parameters)


@pytest.mark.parametrize("measurements", [LONG, TWO_TURNS, ONE_RUN])
@pytest.mark.parametrize("edition", SINCE_1997)
def test_one_run_of_iso_defines_systematic_deviations_and_reversal_only(
    edition: str, measurements: MeasurementSet
) -> None:
    assert defined(edition, measurements) == "E E_fwd E_bwd M B B_mean"


def test_one_run_of_iso_1988_defines_the_reversal_only() -> None:
    assert defined("iso230-2:1988", LONG) == "B B_mean"


@pytest.mark.parametrize("identifier", ["vdi-dgq-3441", "vdi-vde-2617"])
def test_one_run_of_vdi_defines_position_deviation_and_reversal(identifier: str) -> None:
    assert defined(identifier, ONE_RUN) == "Pa U_max U_mean"


def test_one_run_of_nmtba_has_a_sample_of_both_directions() -> None:
    assert defined("nmtba", ONE_RUN) == "P Pa Ps_max Ps_mean O"


@pytest.mark.parametrize(
    ("identifier", "upwards", "downwards"),
    [
        ("iso230-2:1988", "A_fwd R_fwd", "A_bwd R_bwd"),
        ("iso230-2:2014", "A_fwd E_fwd R_fwd", "A_bwd E_bwd R_bwd"),
        ("vdi-dgq-3441", "P Pa Ps_max Ps_mean", "P Pa Ps_max Ps_mean"),
        ("vdi-vde-2617", "P Pa Ps_max Ps_mean", "P Pa Ps_max Ps_mean"),
        ("nmtba", "P Pa Ps_max Ps_mean O", "P Pa Ps_max Ps_mean O"),
    ],
)
def test_one_direction_defines_what_needs_no_other(identifier: str, upwards: str, downwards: str) -> None:
    assert defined(identifier, UPWARDS) == upwards
    assert defined(identifier, DOWNWARDS) == downwards


@pytest.mark.parametrize(
    ("identifier", "symbols"),
    [
        ("iso230-2:1988", ""),
        ("iso230-2:2014", "E_fwd"),
        ("vdi-dgq-3441", "Pa"),
        ("vdi-vde-2617", "Pa"),
        ("nmtba", "Pa"),
    ],
)
def test_one_run_in_one_direction_defines_hardly_anything(identifier: str, symbols: str) -> None:
    assert defined(identifier, ONE_RUN_UPWARDS) == symbols


def test_five_runs_on_a_long_axis_are_evaluated_in_full() -> None:
    assert len(evaluated("iso230-2:2014", simulated_test(13, 5, length=3000)).parameters) == 12


def test_vdi_in_one_direction_forms_position_spread_and_uncertainty_from_it() -> None:
    found = evaluated("vdi-dgq-3441", UPWARDS)
    s, mean = found.statistics.s_positive, found.statistics.mean_positive

    assert found.value("Ps_max") == pytest.approx(6 * s.max())
    assert found.value("P") == pytest.approx(np.max(mean + 3 * s) - np.min(mean - 3 * s))


GAP = np.nan
UP = np.array([[1.0, 3.0, 2.0], [5.0, 7.0, 9.0], [2.0, 2.0, 5.0]])
DOWN = np.array([[0.0, 1.0, 2.0], [GAP, GAP, GAP], [1.0, 4.0, 1.0]])
WITHOUT_A_DIRECTION = bidirectional_test([0, 100, 200], UP, DOWN)


@pytest.mark.parametrize(
    ("identifier", "symbols"),
    [
        ("iso230-2:2014", ["R"]),
        ("vdi-dgq-3441", ["U", "Ps"]),
        ("vdi-vde-2617", ["U", "Ps"]),
        ("nmtba", ["X", "Ps"]),
    ],
)
def test_a_target_without_one_direction_has_no_bidirectional_values(
    identifier: str, symbols: list[str]
) -> None:
    found = evaluated(identifier, WITHOUT_A_DIRECTION)

    for symbol in symbols:
        assert np.isnan(found.column(symbol)).tolist() == [False, True, False]


def test_a_target_without_one_direction_counts_in_what_takes_each_direction_by_itself() -> None:
    found = evaluated("iso230-2:2014", WITHOUT_A_DIRECTION)

    assert found.value("E_fwd") == pytest.approx((7 - 2) * 1e-6)
    assert found.value("E") == pytest.approx((7 - 1) * 1e-6)
    assert found.value("M") == pytest.approx((2.5 - 1.5) * 1e-6)
    assert found.value("B") == pytest.approx(1e-6)


def test_a_missing_reading_lowers_n_of_the_nmtba_sample_at_its_position() -> None:
    lacking = bidirectional_test([0], [[2.0, 4.0, GAP]], [[0.0, 2.0, 7.0]])
    found = evaluated("nmtba", lacking)

    # Mean of 2, 4, 0, 2, 7 is 3; the squares about it are 1 + 1 + 9 + 1 + 16, on 4 degrees of freedom.
    assert found.column("X").tolist() == pytest.approx([3e-6])
    assert found.column("Ps").tolist() == pytest.approx([6e-6 * np.sqrt(28 / 4)])


@pytest.mark.parametrize("identifier", ["iso230-2:1988", "iso230-2:2014", "vdi-dgq-3441", "vdi-vde-2617"])
def test_of_a_single_run_no_standard_deviation_is_spoken_of(identifier: str) -> None:
    whole, single = (
        " ".join(note.in_language(Language.ENGLISH) for note in evaluated(identifier, test).notes)
        for test in (simulated_test(), ONE_RUN)
    )
    assert "standard deviations (n − 1)" in whole
    assert "standard deviations (n − 1)" not in single
    assert "No parameter is a ± value" in single
