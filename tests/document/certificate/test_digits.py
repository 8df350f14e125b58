"""Digits: U has two, its value as many, and no number of a document contradicts another."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import certificate, having
from plugins.standards.installed import STANDARDS
from zlmreport.document.certificate.values import write_coverage_factor
from zlmreport.document.writer import write_uncertainty, write_with_uncertainty
from zlmreport.language.formatting import write_plain
from zlmreport.plugin import MICROMETRE, MILLIMETRE, Language
from zlmreport.plugin.renderer import EvaluatedParameter, Symbol, Table, Writer

#: Of readings with two decimals.
SCRIBE = Writer(Language.ENGLISH, MILLIMETRE, MICROMETRE, 0, 2)


def parameter(value: float, expanded: float | None, factor: float = 2.0) -> EvaluatedParameter:
    """Return a parameter with values in micrometres."""
    quantity = STANDARDS["iso230-2:2014"].quantities[0]
    return EvaluatedParameter(
        quantity, value * 1e-6, expanded_uncertainty=expanded and expanded * 1e-6, coverage_factor=factor
    )


@pytest.mark.parametrize(
    ("value", "expanded", "expected"),
    [
        (12.3456, 1.234, ("12.3", "1.2")),
        (12.3456, 0.123, ("12.35", "0.12")),
        (1234.56, 123.4, ("1230", "120")),
        # Two digits of U always, whatever the readings show.
        (12.34567, 0.00149, ("12.3457", "0.0015")),
        # None known: as the readings. None at all: said to be none.
        (12.3456, None, ("12.35", "–")),
        (12.3456, 0.0, ("12.35", "0")),
    ],
)
def test_a_value_is_rounded_with_its_uncertainty(
    value: float, expanded: float | None, expected: tuple[str, str]
) -> None:
    assert write_with_uncertainty(parameter(value, expanded), SCRIBE) == expected


def test_the_decimal_sign_is_that_of_the_document() -> None:
    german = replace(SCRIBE, language=Language.GERMAN)

    assert write_with_uncertainty(parameter(12.3456, 0.123), german) == ("12,35", "0,12")
    assert write_coverage_factor(parameter(1.0, 0.1, 1.653), german) == "1,65"


@pytest.mark.parametrize("expanded", [None, 0.0])
def test_what_has_no_uncertainty_has_no_coverage_factor(expanded: float | None) -> None:
    assert write_coverage_factor(parameter(1.0, expanded), SCRIBE) == "–"


@pytest.mark.parametrize(
    ("micrometres", "expected"), [(0.456, "0.46"), (0.0, "0"), (float("nan"), "–"), (0.0001, "0.00010")]
)
def test_an_uncertainty_by_itself_keeps_two_digits(micrometres: float, expected: str) -> None:
    assert write_uncertainty(micrometres * 1e-6, SCRIBE) == expected


TARGETS = range(0, 401, 40)
ISO = {"standard": "iso230-2:2014", "tolerances": {"A": 150, "E": 100}}
VDI = {"standard": "vdi-dgq-3441", "tolerances": {"P": 150}}


def _deviation(target: int, way: str, run: int) -> float:
    return 0.01 * target + 2.3137 * ((7 * run + target // 40) % 5) + (1.7 if way == "-" else 0.0)


def _tables(  # noqa: PLR0913 - the readings of a test
    folder: Path,
    decimals: int,
    expanded: float,
    runs: int = 5,
    evaluated: Mapping[str, Any] = ISO,
    *,
    ways: str = "+-",
) -> list[Table]:
    """Return the tables of the results of a test whose readings have so many decimals."""
    folder.mkdir(exist_ok=True)
    rows = [
        f"{target},{way},{run},{_deviation(target, way, run):.{decimals}f}"
        for run in range(1, runs + 1)
        for way in ways
        for target in (TARGETS if way == "+" else reversed(TARGETS))
    ]
    (folder / "x.csv").write_text(
        "\n".join(["target,direction,run,deviation", *rows]) + "\n", encoding="utf-8"
    )
    keys = having("measurement.source", {"plugin": "laser-csv", "file": "x.csv"})
    keys = having("axis", {"name": "X", "kind": "linear"}, keys)
    keys = having("instrument.expanded_uncertainty", expanded, keys)
    keys = having("certificate.layout", "full", keys)
    keys = having("evaluate", [evaluated], keys)
    key = evaluated["standard"].replace(":", "-")
    (section,) = (each for each in certificate(folder, keys).sections if each.key == key)
    return [block for block in section.blocks if isinstance(block, Table)]


def _rows(table: Table) -> list[dict[str, str]]:
    heads = [
        write_plain(each.heading.notation) if isinstance(each.heading, Symbol) else each.heading
        for each in table.columns
    ]
    return [
        dict(
            zip(
                heads,
                (write_plain(cell.notation) if isinstance(cell, Symbol) else str(cell) for cell in row),
                strict=True,
            )
        )
        for group in table.groups
        for row in group.rows
    ]


def _decimals(number: str) -> int:
    return len(number.partition(".")[2])


def _unit(number: str) -> float:
    """Return one unit of the last digit of a number that was rounded."""
    whole = number.lstrip("−")
    zeros = len(whole) - len(whole.rstrip("0")) if "." not in whole else 0
    return 10.0 ** (zeros if zeros and len(whole) > 2 else -_decimals(number))


@pytest.mark.parametrize("expanded", [0.06, 0.432, 2.0, 32.1])
@pytest.mark.parametrize("decimals", [0, 1, 3])
def test_digits_of_values_follow_u_those_of_means_the_readings_and_none_contradicts(
    tmp_path: Path, decimals: int, expanded: float
) -> None:
    parameters, _, positions, *_ = _tables(tmp_path, decimals, expanded)
    of_page = _rows(parameters)
    for row in of_page:
        assert len(re.sub(r"^0[.0]*|\D", "", row["U"])) == 2, row
        assert _decimals(row["Value"]) == _decimals(row["U"]), row
    by_position = _rows(positions)
    for row in by_position:
        assert {_decimals(row[name]) for name in ("x̄i↑", "si↑", "x̄i↓", "si↓", "x̄i", "Bi")} == {decimals + 1}
        # 4s as a reader computes it from the page: off by what both were rounded, and no more.
        for way in "↑↓":
            allowed = 2 * _unit(row[f"si{way}"]) + _unit(row[f"Ri{way}"]) / 2
            assert abs(4 * float(row[f"si{way}"]) - float(row[f"Ri{way}"])) <= allowed * (1 + 1e-9)
    values = {row["Symbol"]: row["Value"] for row in of_page}
    for symbol, column in (("R", "Ri"), ("R↑", "Ri↑"), ("R↓", "Ri↓")):
        largest = max((row[column] for row in by_position), key=float)
        allowed = (_unit(values[symbol]) + _unit(largest)) / 2
        assert abs(float(values[symbol]) - float(largest)) <= allowed * (1 + 1e-9)


@pytest.mark.parametrize(("runs", "decimals"), [(1, 2), (5, 3)])
def test_a_mean_has_a_digit_more_than_readings_where_it_is_one(
    tmp_path: Path, runs: int, decimals: int
) -> None:
    (by_position,) = (each for each in _tables(tmp_path, 2, 2.0, runs) if each.dense)
    for row in _rows(by_position):
        assert {_decimals(row[name]) for name in ("x̄i↑", "x̄i↓", "Bi")} == {decimals}
        assert _decimals(row["x̄i"]) == 3  # of both directions, always of several


def test_a_reversal_span_of_a_single_run_has_the_digits_of_its_readings(tmp_path: Path) -> None:
    (by_position,) = (each for each in _tables(tmp_path, 2, 2.0, 1, VDI) if each.dense)
    assert {_decimals(row["Uj"]) for row in _rows(by_position)} == {2}


def test_a_table_tells_no_column_apart_that_it_does_not_have(tmp_path: Path) -> None:
    (both,) = (each for each in _tables(tmp_path, 2, 2.0, 5, VDI) if each.dense)
    (one,) = (each for each in _tables(tmp_path, 2, 2.0, 5, VDI, ways="+") if each.dense)
    assert "Reversal span" in both.caption
    assert "Reversal span" not in one.caption
