"""What every standard must be: its definitions and its graphs here, its formulas in the module beside."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from zlmreport.document.figures.figure import Arrow, Band, Bracket, Curve, Figure, Panel, PlottedReadings
from zlmreport.errors import PluginError
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.evaluation import (
    Basis,
    Evaluation,
    Finding,
    PositionQuantity,
    Quantity,
    QuantityGroup,
)
from zlmreport.job.types import Options
from zlmreport.language import Language
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.measurement.units import ANGLES, LENGTHS, TIMES, Unit
from zlmreport.plugin.kinds import STANDARD
from zlmreport.plugin.protocols import Standard
from zlmreport.testing.arithmetic import ARITHMETIC_CHECKS
from zlmreport.testing.examples import EXAMPLE_CHECKS, WorkedExample
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_identifier,
    expect_members,
    expect_named,
    expect_options,
    expect_words,
    guard_subject,
    is_same_value,
    list_checks_of,
    run_all,
)
from zlmreport.testing.measurements import good_tests, poor_tests

_INDICES = frozenset("ij")
#: Columns that every table by position has.
_CORE_COLUMNS = frozenset({"target", "mean_fwd", "mean_bwd", "mean", "s_fwd", "s_bwd", "reversal"})

_UNITS = {unit.symbol: unit for unit in (*LENGTHS, *ANGLES, *TIMES.values())}
#: Of a panel that shows a condition beside deviations.
_OF_CONDITIONS = frozenset(kind.unit.symbol for kind in CONDITIONS.values())
#: Of a value on a graph, which went through a change of unit; relative to the largest.
_RELATIVE = 1e-9


@check
def is_named(standard: Standard, *_more: Any) -> None:
    """Check that it has an identifier that can be typed, a designation, and a title in every language."""
    expect_named(standard, STANDARD)
    expect(standard.designation.strip(), f"{standard.identifier}: designation must be what is printed")
    expect(
        standard.position_index in _INDICES,
        f"{standard.identifier}: position_index {standard.position_index!r} must be 'i' or 'j', "
        "the letter that counts positions in its symbols",
    )
    for number, note in enumerate(standard.notes, 1):
        expect_words(note, f"{standard.identifier}: note {number}")


@check
def options_are_described(standard: Standard, *_more: Any) -> None:
    """Check that its job keys are described, and none is a key of the core."""
    expect_options(standard, STANDARD)


@check
def symbols_are_unique(standard: Standard, *_more: Any) -> None:
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
def quantities_are_worded(standard: Standard, *_more: Any) -> None:
    """Check that each quantity has its notation, and says in every language what it is and what it means."""
    described: Iterable[Quantity | PositionQuantity] = (*standard.quantities, *standard.position_quantities)
    for quantity in described:
        where = f"{standard.identifier}: {quantity.symbol}"
        expect(write_plain(quantity.notation).strip(), f"{where}: notation must be what is printed")
        expect_words(quantity.name, f"{where}: name")
    for parameter in standard.quantities:
        where = f"{standard.identifier}: {parameter.symbol}"
        expect(
            isinstance(parameter.group, QuantityGroup),
            f"{where}: group must be a QuantityGroup, not {parameter.group!r}",
        )
        expect(write_plain(parameter.formula).strip(), f"{where}: formula must be the definition as printed")
        expect_words(parameter.meaning, f"{where}: meaning")


@check
def requirements_never_refuse(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that requirements answer with findings, however poor the test is, and answer the same again."""
    guarded = guard_subject(standard, STANDARD)
    for kind, measurements in {**good_tests(standard), **poor_tests(standard)}.items():
        where = f"{standard.identifier}: requirements on {kind}"
        try:
            findings, again = (guarded.requirements(measurements, options) for _ in range(2))
        except PluginError as error:
            said = error.problems[0].message
            message = f"{said} (on {kind}); a test that falls short gives a finding, not an error"
            raise AssertionError(message) from error
        for number, finding in enumerate(findings, 1):
            _expect_finding(finding, f"{where}: finding {number}")
        expect(is_same_value(findings, again), f"{where}: the second answer differs from the first")


def _expect_finding(finding: Finding, where: str) -> None:
    expect_words(finding.requirement, f"{where}: requirement")
    expect_words(finding.found, f"{where}: found")
    expect(isinstance(finding.basis, Basis), f"{where}: basis must be a Basis, not {finding.basis!r}")


@check
def figures_of_any_test(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that a complete test gives graphs, and a poor test graphs of what there is, or none."""
    good, poor = good_tests(standard), poor_tests(standard)
    for kind, measurements in {**good, **poor}.items():
        where = f"{standard.identifier}: figures of {kind}"
        evaluation = evaluate(standard, measurements, options, {})
        try:
            figures = tuple(standard.figures(evaluation, options))
            again = tuple(standard.figures(evaluation, options))
        except Exception as error:
            message = f"{where} raised {error!r}; a poor test gives graphs of what there is"
            raise AssertionError(message) from error
        expect(figures or kind in poor, f"{where}: there is none")
        for key, times in Counter(figure.key for figure in figures).items():
            expect(times == 1, f"{where}: key {key!r} is there {times} times; keys are unique")
        expect(is_same_value(figures, again), f"{where}: the second time they differ from the first")


@check
def figures_are_worded(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that a graph has its caption, its axes, and a description with its values, in every language."""
    for where, figure, _ in _list_figures(standard, options):
        expect_identifier(figure.key, f"{where}: key")
        for name, words in (
            ("title", figure.title),
            ("alternative", figure.alternative),
            ("x_title", figure.x_title),
            ("y_title", figure.y_title),
        ):
            expect_words(words, f"{where}: {name}")
        for unit in (figure.x_unit, figure.y_unit):
            expect(unit in _UNITS, f"{where}: unit {unit!r} is none of {', '.join(_UNITS)}")
        for panel in figure.panels:
            quantity, unit = figure.value_axis(panel)
            expect_words(quantity, f"{where}: y_title of a panel")
            known = {*_UNITS, *_OF_CONDITIONS}
            expect(unit in known, f"{where}: unit {unit!r} of a panel is none of {', '.join(sorted(known))}")
    for kind in good_tests(standard):
        for where, figure, _ in _list_figures(standard, options, kind):
            for language in Language:
                text = figure.alternative.in_language(language)
                expect(
                    any(map(str.isdigit, text)),
                    f"{where}: alternative in '{language}' names no value: {text!r}",
                )


@check
def marks_stand_at_targets(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that curves, bands, arrows and brackets stand at target positions of the test.

    A wire picture shows places of a body, and not positions.
    """
    for where, figure, evaluation in _list_figures(standard, options):
        lines = [line.target_positions for line in evaluation.measurements.lines]
        targets = _UNITS[figure.x_unit].from_si(np.concatenate(lines))
        for panel in (each for each in figure.panels if not each.is_wire):
            for mark in _list_marks(panel):
                expect(
                    mark.x.ndim == 1 and _is_all_among(mark.x, targets),
                    f"{where}: {_name(mark)} stands at positions that are no targets: {mark.x}"
                    f"{_say_if_si(mark.x, np.concatenate(lines), figure.x_unit)}",
                )
            for arrow in panel.arrows:
                expect(
                    _is_all_among(arrow.x, targets),
                    f"{where}: arrow {write_plain(arrow.notation)} stands at {arrow.x}, "
                    "no target of the test",
                )
            for bracket in panel.brackets:
                for end, position in (("low_at", bracket.low_at), ("high_at", bracket.high_at)):
                    expect(
                        _is_all_among(position, targets),
                        f"{where}: {end} of bracket {write_plain(bracket.notation)} is {position}, no target",
                    )


@check
def curves_have_a_value_at_each_position(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that curves and bands have a value at each position, and a band its limits in order."""
    for where, figure, _ in _list_figures(standard, options):
        for panel in figure.panels:
            for mark in _list_marks(panel):
                values = (mark.lower, mark.upper) if isinstance(mark, Band) else (mark.y,)
                for value in values:
                    expect(
                        value.shape == mark.x.shape and not np.any(np.isinf(value)),
                        f"{where}: {_name(mark)} needs a finite value, or NaN, at each position: {value}",
                    )
            for band in panel.bands:
                expect(
                    not np.any(band.lower > band.upper),
                    f"{where}: {_name(band)} has a lower limit above its upper limit",
                )


@check
def marks_have_finite_ends(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that arrows, brackets and levels have finite ends, the lower one first."""
    for where, figure, _ in _list_figures(standard, options):
        for panel in figure.panels:
            spans: tuple[Arrow | Bracket, ...] = (*panel.arrows, *panel.brackets)
            for mark in spans:
                expect(
                    np.isfinite(mark.low) and np.isfinite(mark.high) and mark.low <= mark.high,
                    f"{where}: {write_plain(mark.notation)} spans {mark.low} to {mark.high}; "
                    "expected finite ends, the lower one first; leave out what the test does not define",
                )
            for level in panel.levels:
                expect(np.isfinite(level.y), f"{where}: level {write_plain(level.notation)} is at {level.y}")


@check
def brackets_span_what_is_drawn(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that a bracket's ends are values that the panel shows at their targets, or its zero line."""
    for where, figure, _ in _list_figures(standard, options):
        for panel in figure.panels:
            for bracket in panel.brackets:
                for end, value, position in (
                    ("low", bracket.low, bracket.low_at),
                    ("high", bracket.high, bracket.high_at),
                ):
                    shown = _list_values_at(panel, position)
                    expect(
                        _is_all_among(value, shown),
                        f"{where}: {end} end of bracket {write_plain(bracket.notation)} is {value}; "
                        f"nothing is drawn there at {position}, but {np.unique(shown)}",
                    )


@check
def brackets_are_as_long_as_their_parameter(standard: Standard, options: Options, *_more: Any) -> None:
    """Check that a bracket that carries a parameter's notation spans exactly the parameter's value."""
    for where, figure, evaluation in _list_figures(standard, options):
        for panel in figure.panels:
            unit = _UNITS.get(figure.value_axis(panel)[1])
            if unit is None:  # of a condition, which no parameter is
                continue
            for bracket in panel.brackets:
                for value in _list_values_of(bracket, evaluation, unit):
                    scale = max(abs(bracket.low), abs(bracket.high), abs(value))
                    expect(
                        abs((bracket.high - bracket.low) - abs(value)) <= 2 * _RELATIVE * scale,
                        f"{where}: bracket {write_plain(bracket.notation)} spans "
                        f"{bracket.high - bracket.low} {unit.symbol}, but the results table has {value}"
                        f"{_say_if_si(bracket.high - bracket.low, abs(unit.to_si(value)), unit.symbol)}",
                    )


def _list_figures(
    standard: Standard, options: Options, kind: str | None = None
) -> Iterator[tuple[str, Figure, Evaluation]]:
    """Yield every figure of every test (or of one kind of test), with what to call it in a sentence."""
    tests = {**good_tests(standard), **poor_tests(standard)}
    for name in tests if kind is None else [kind]:
        evaluation = evaluate(standard, tests[name], options, {})
        for figure in standard.figures(evaluation, options):
            yield f"{standard.identifier}: figure '{figure.key}' of {name}", figure, evaluation


def _list_marks(panel: Panel) -> tuple[Curve | Band | PlottedReadings, ...]:
    """Return what has a value at each of many positions."""
    return (*panel.curves, *panel.bands, *panel.readings)


def _name(mark: Curve | Band | PlottedReadings) -> str:
    if isinstance(mark, PlottedReadings):
        return f"the readings {mark.approach.arrow}"
    return f"{type(mark).__name__.lower()} {write_plain(mark.notation)}"


def _say_if_si(values: float | FloatArray, of_si: float | FloatArray, unit: str) -> str:
    """Return the end of a message on values that are right in SI, and stand in a graph of another unit."""
    is_si = _is_all_among(values, np.atleast_1d(of_si))
    return f"; that is SI: a graph has its own unit, {unit} (from_si)" if is_si else ""


def _is_all_among(values: float | FloatArray, allowed: FloatArray) -> bool:
    """Return whether each value is, but for the rounding of a change of unit, among the allowed ones."""
    values = np.atleast_1d(values)
    tolerance = _RELATIVE * max(np.max(np.abs(allowed), initial=0.0), np.max(np.abs(values), initial=0.0))
    return all(np.any(np.abs(allowed - value) <= tolerance) for value in values)


def _list_values_at(panel: Panel, position: float) -> FloatArray:
    """Return every value that a panel shows at a position, that of its zero line among them."""
    values = [np.zeros(1), np.array([level.y for level in panel.levels])]
    values += [curve.y[np.isclose(curve.x, position)] for curve in panel.curves]
    values += [readings.y[np.isclose(readings.x, position)] for readings in panel.readings]
    for band in panel.bands:
        there = np.isclose(band.x, position)
        values += [band.lower[there], band.upper[there]]
    for arrow in panel.arrows:
        if np.isclose(arrow.x, position):
            values.append(np.array([arrow.low, arrow.high]))
    shown = np.concatenate(values)
    defined: FloatArray = shown[~np.isnan(shown)]
    return defined


def _list_values_of(bracket: Bracket, evaluation: Evaluation, unit: Unit) -> Iterator[float]:
    for parameter in evaluation.parameters:
        if parameter.quantity.notation == bracket.notation:
            yield unit.from_si(parameter.value)


#: Every check of a standard, each called with it, its options, its author's examples and other keys.
STANDARD_CHECKS = (*list_checks_of(__name__), *ARITHMETIC_CHECKS, *EXAMPLE_CHECKS)


def check_standard(
    standard: Standard,
    keys: Mapping[str, Any] | None = None,
    *,
    examples: Sequence[WorkedExample] = (),
    other_keys: Mapping[str, Any] | None = None,
) -> None:
    """Run every check on a standard.

    Parameters
    ----------
    standard
        The object that the plugin's hook returns.
    keys
        Its job keys, as a job file would give them; none where all have defaults.
    examples
        Tests with the values that the standard gives them, from its text or computed by hand; without one the
        kit cannot tell a wrong factor from a right one, and does not pass.
    other_keys
        Another value of job keys, each of which changes a result, where the kit finds none by its type.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    expect_members(standard, STANDARD)
    options = standard.options.model_validate(keys or {})
    run_all(STANDARD, STANDARD_CHECKS, standard, options, examples, other_keys or {})
