"""Results that others have printed, from readings that they have printed."""

from __future__ import annotations

import csv
import json
import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.plugin import Axis, AxisKind, Evaluation
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test

PUBLISHED = Path(__file__).parents[2] / "data" / "published"
RESULTS: dict[str, Any] = json.loads((PUBLISHED / "results.json").read_text("utf-8"))
LINEAR = [name for name, results in RESULTS.items() if results["axis"] == "linear"]
ROTARY = "avs_bifrost_FAT_rotary"
EDITIONS = ["iso230-2:1997", "iso230-2:2006", "iso230-2:2014"]

#: µm: readings are printed to 0.01 µm, results to 0.00001 mm.
READING = RESULT = 0.005


@cache
def evaluated(name: str, standard: str) -> Evaluation:
    with (PUBLISHED / f"{name}.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    targets = sorted({float(row["target"]) for row in rows})
    runs = max(int(row["run"]) for row in rows)
    grid = {sign: np.full((len(targets), runs), np.nan) for sign in "+-"}
    for row in rows:
        grid[row["direction"]][targets.index(float(row["target"])), int(row["run"]) - 1] = float(
            row["deviation"]
        )
    axis = Axis("X", AxisKind(RESULTS[name]["axis"]))
    measurements = bidirectional_test(targets, grid["+"], grid["-"], axis=axis)
    of_edition = STANDARDS[standard]
    return evaluate(of_edition, measurements, of_edition.options(), {})


def parameter(name: str, standard: str, symbol: str) -> float:
    """Return a parameter in µm (″)."""
    evaluation = evaluated(name, standard)
    value = evaluation.value(symbol)
    return evaluation.measurements.axis.deviation_unit.from_si(value)


def column(name: str, standard: str, symbol: str) -> list[float]:
    """Return a column of the table by position in µm (″)."""
    evaluation = evaluated(name, standard)
    statistics = evaluation.statistics
    common = {
        "mean_fwd": statistics.mean_positive,
        "mean_bwd": statistics.mean_negative,
        "mean": statistics.mean_bidirectional,
        "reversal": statistics.reversal_value,
        "abs_reversal": np.abs(statistics.reversal_value),
        "s_fwd": statistics.s_positive,
        "s_bwd": statistics.s_negative,
    }
    values = common[symbol] if symbol in common else evaluation.column(symbol)
    return evaluation.measurements.axis.deviation_unit.from_si(values).tolist()


def tolerance(symbol: str, runs: int) -> float:
    """Return the most by which rounding of the printed readings and of the printed result can part them.

    Readings off by up to δ move a mean by up to δ, a difference of two means by up to 2δ, and a standard
    deviation by up to δ·√(n/(n − 1)), which is reached when half of them go one way and half the other.
    Largest and smallest values move by no more than what they are taken from.
    """
    mean, s = READING, READING * math.sqrt(runs / (runs - 1))
    by_symbol = {
        **dict.fromkeys(["mean_fwd", "mean_bwd", "mean"], mean),
        **dict.fromkeys(["reversal", "B", "B_mean", "E", "E_fwd", "E_bwd", "M"], 2 * mean),
        **dict.fromkeys(["s_fwd", "s_bwd"], s),
        **dict.fromkeys(["R_fwd", "R_bwd"], 4 * s),
        "R": 4 * s + 2 * mean,
        **dict.fromkeys(["A", "A_fwd", "A_bwd"], 2 * (mean + 2 * s)),
    }
    return by_symbol[symbol] + RESULT


def printed_parameters() -> list[Any]:
    return [
        pytest.param(name, edition, symbol, value, id=f"{edition}/{name}/{symbol}")
        for name in LINEAR
        for symbol, value in RESULTS[name]["parameters"].items()
        for edition in EDITIONS
    ]


def printed_columns() -> list[Any]:
    return [
        pytest.param(name, symbol, id=f"{name}/{symbol}")
        for name in LINEAR
        for symbol in RESULTS[name]["positions"][0]
        if symbol != "target"
    ]


def known_wrong() -> list[Any]:
    return [
        pytest.param(name, symbol, values["printed"], values["by_definition"], id=f"{name}/{symbol}")
        for name in LINEAR
        for symbol, values in RESULTS[name]["known_wrong"].items()
    ]


@pytest.mark.parametrize(("name", "edition", "symbol", "printed"), printed_parameters())
def test_parameter_is_the_printed_one(name: str, edition: str, symbol: str, printed: float) -> None:
    assert parameter(name, edition, symbol) == pytest.approx(1e3 * printed, abs=tolerance(symbol, runs=5))


@pytest.mark.parametrize(("name", "symbol"), printed_columns())
def test_column_by_position_is_the_printed_one(name: str, symbol: str) -> None:
    printed = [1e3 * position[symbol] for position in RESULTS[name]["positions"]]

    assert column(name, "iso230-2:2014", symbol) == pytest.approx(printed, abs=tolerance(symbol, runs=5))


def test_53_parameters_agree_and_7_are_known_to_be_wrong() -> None:
    agree = sum(len(RESULTS[name]["parameters"]) for name in LINEAR)
    wrong = sum(len(RESULTS[name]["known_wrong"]) for name in LINEAR)

    assert (agree, wrong) == (53, 7)


@pytest.mark.parametrize(("name", "symbol", "printed", "by_definition"), known_wrong())
def test_wrongly_printed_parameter_is_not_matched(
    name: str, symbol: str, printed: float, by_definition: float
) -> None:
    found = parameter(name, "iso230-2:2014", symbol)

    assert found == pytest.approx(1e3 * by_definition, abs=tolerance(symbol, runs=5))
    assert abs(found - 1e3 * printed) > tolerance(symbol, runs=5)


@pytest.mark.parametrize("symbol", ["R_fwd", "R_bwd", "abs_reversal"])
def test_rotary_workbook_is_reproduced_to_its_last_digits(symbol: str) -> None:
    printed = [3600 * position[symbol] for position in RESULTS[ROTARY]["positions"]]

    # The workbook holds angles up to 40° as doubles: 7e-15° of rounding each, 2.6e-11″.
    assert column(ROTARY, "iso230-2:2014", symbol) == pytest.approx(
        printed, abs=4 * 2.6e-11 * math.sqrt(10 / 9)
    )


def test_rotary_repeatability_is_by_definition_and_not_as_reported() -> None:
    wrong = RESULTS[ROTARY]["known_wrong"]["R"]
    found = parameter(ROTARY, "iso230-2:2014", "R") / 3600

    assert found == pytest.approx(wrong["by_definition"], abs=0.5e-5)
    assert abs(found - wrong["printed"]) > 0.005
