"""What every standard must be: its definitions here, its formulas and graphs in the modules beside."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

from zlmreport.evaluation.evaluation import Basis, Finding, Group, PositionQuantity, Quantity
from zlmreport.job.types import Options
from zlmreport.plugin.protocols import Standard
from zlmreport.quantities.formatting import plain
from zlmreport.testing.arithmetic import ARITHMETIC_CHECKS
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_identifier,
    expect_members,
    expect_options,
    expect_own_keys,
    expect_words,
    run_all,
    same_value,
)
from zlmreport.testing.graphs import GRAPH_CHECKS
from zlmreport.testing.measurements import good_tests, poor_tests

_INDICES = frozenset("ij")
#: Columns that every table by position has, and keys of a job that belong to every standard.
_CORE_COLUMNS = frozenset({"target", "mean_fwd", "mean_bwd", "mean", "s_fwd", "s_bwd", "reversal"})
_CORE_KEYS = frozenset({"standard", "tolerances"})


@check
def has_all_members(standard: Standard, _: Options) -> None:
    """Check that the protocol is complete."""
    expect_members(standard, Standard)


@check
def is_named(standard: Standard, _: Options) -> None:
    """Check that it has an identifier that can be typed, a designation, and a title in every language."""
    expect_identifier(standard.identifier, repr(standard))
    expect(standard.designation.strip(), f"{standard.identifier}: designation must be what is printed")
    expect_words(standard.title, f"{standard.identifier}: title")
    expect(
        standard.position_index in _INDICES,
        f"{standard.identifier}: position_index {standard.position_index!r} must be 'i' or 'j', "
        "the letter that counts positions in its symbols",
    )
    for number, note in enumerate(standard.notes, 1):
        expect_words(note, f"{standard.identifier}: note {number}")


@check
def options_are_described(standard: Standard, _: Options) -> None:
    """Check that its job keys are described, and none is a key of the core."""
    expect_options(standard.options, standard.identifier)
    expect_own_keys(standard.options, _CORE_KEYS, standard.identifier)


@check
def symbols_are_unique(standard: Standard, _: Options) -> None:
    """Check that symbols are ASCII, unique, and none is that of a column which every table has."""
    expect(standard.quantities, f"{standard.identifier} reports no parameter: quantities is empty")
    for owner, symbols in (
        ("quantities", [quantity.symbol for quantity in standard.quantities]),
        ("position_quantities", [quantity.symbol for quantity in standard.position_quantities]),
    ):
        for symbol, times in Counter(symbols).items():
            where = f"{standard.identifier}: {owner}: symbol {symbol!r}"
            expect(times == 1, f"{where} is there {times} times; symbols are unique")
            expect(symbol.isascii() and symbol.isidentifier(), f"{where} must be ASCII, as 'A_fwd' is")
    for quantity in standard.position_quantities:
        expect(
            quantity.symbol not in _CORE_COLUMNS,
            f"{standard.identifier}: position_quantities: {quantity.symbol!r} is a column of every table",
        )


@check
def quantities_are_worded(standard: Standard, _: Options) -> None:
    """Check that each quantity has its notation, and says in every language what it is and what it means."""
    described: Iterable[Quantity | PositionQuantity] = (*standard.quantities, *standard.position_quantities)
    for quantity in described:
        where = f"{standard.identifier}: {quantity.symbol}"
        expect(plain(quantity.notation).strip(), f"{where}: notation must be what is printed")
        expect_words(quantity.name, f"{where}: name")
    for parameter in standard.quantities:
        where = f"{standard.identifier}: {parameter.symbol}"
        expect(isinstance(parameter.group, Group), f"{where}: group must be a Group, not {parameter.group!r}")
        expect(plain(parameter.formula).strip(), f"{where}: formula must be the definition as printed")
        expect_words(parameter.meaning, f"{where}: meaning")


@check
def requirements_never_refuse(standard: Standard, options: Options) -> None:
    """Check that requirements answer with findings, however poor the test is, and answer the same again."""
    for kind, measurements in {**good_tests(), **poor_tests()}.items():
        where = f"{standard.identifier}: requirements on {kind}"
        try:
            findings = tuple(standard.requirements(measurements, options))
            again = tuple(standard.requirements(measurements, options))
        except Exception as error:
            message = f"{where} raised {error!r}; a test that falls short gives a finding, not an error"
            raise AssertionError(message) from error
        for number, finding in enumerate(findings, 1):
            _expect_finding(finding, f"{where}: finding {number}")
        expect(same_value(findings, again), f"{where}: the second answer differs from the first")


def _expect_finding(finding: object, where: str) -> None:
    expect(isinstance(finding, Finding), f"{where} must be a Finding, not {finding!r}")
    assert isinstance(finding, Finding)  # noqa: S101  # said above; for type checkers
    expect_words(finding.requirement, f"{where}: requirement")
    expect_words(finding.found, f"{where}: found")
    expect(
        finding.met in {True, False, None}, f"{where}: met must be True, False or None, not {finding.met!r}"
    )
    expect(isinstance(finding.basis, Basis), f"{where}: basis must be a Basis, not {finding.basis!r}")


#: Every check of a standard, each called with the standard and its validated options.
STANDARD_CHECKS = (
    has_all_members,
    is_named,
    options_are_described,
    symbols_are_unique,
    quantities_are_worded,
    requirements_never_refuse,
    *ARITHMETIC_CHECKS,
    *GRAPH_CHECKS,
)


def check_standard(standard: Standard, keys: Mapping[str, Any] | None = None) -> None:
    """Run every check on a standard.

    Parameters
    ----------
    standard
        The object that the plugin's hook returns.
    keys
        Its job keys, as a job file would give them; none where all have defaults.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    expect_members(standard, Standard)
    run_all(STANDARD_CHECKS, standard, standard.options.model_validate(keys or {}))
