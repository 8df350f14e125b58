"""Values and uncertainties in tables: rounded together, and no digit more than is known."""

from __future__ import annotations

from dataclasses import replace

import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.document.certificate.values import Values, write_coverage_factor
from zlmreport.document.writer import write_uncertainty, write_with_uncertainty
from zlmreport.plugin import MICROMETRE, MILLIMETRE, Evaluation, Language, Options
from zlmreport.plugin.renderer import EvaluatedParameter, Writer
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import simulated_test

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


def evaluation(*, uncertain: bool, limited: bool) -> Evaluation:
    found = evaluate(STANDARDS["iso230-2:2014"], simulated_test(), Options(), {"A": 20e-6} if limited else {})
    expanded = 1e-6 if uncertain else None
    parameters = tuple(
        replace(each, expanded_uncertainty=expanded, coverage_factor=2.0) for each in found.parameters
    )
    return replace(found, parameters=parameters)


@pytest.mark.parametrize(
    ("stated", "columns"),
    [
        ({"uncertain": False, "limited": False}, 3),
        ({"uncertain": True, "limited": False}, 5),
        ({"uncertain": False, "limited": True}, 5),
        ({"uncertain": True, "limited": True}, 7),
    ],
)
def test_there_are_columns_for_what_is_stated(stated: dict[str, bool], columns: int) -> None:
    found = evaluation(**stated)

    values = Values.of([found], SCRIBE)

    assert len(tuple(values.list_columns())) == columns
    assert all(len(tuple(values.list_cells(each))) + 2 == columns for each in found.parameters)
