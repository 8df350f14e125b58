"""What the author of a standard computed by hand, or found in print: the numbers that no kit can know.

A factor of 3 where the standard has 2, a term that was left out and a key that nothing reads give values that
look like values; only an example tells them from those of the standard.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated, Any, Literal, get_args, get_origin

import numpy as np
from pydantic import ValidationError

from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.evaluation import QuantityGroup
from zlmreport.evaluation.statistics import compute_statistics_of
from zlmreport.job.types import Options
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.error_symbol import evaluate_for_error
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.protocols import Standard, find_contributions_of
from zlmreport.testing.expectations import check, expect, is_same_value, list_checks_of
from zlmreport.testing.measurements import good_tests, poor_tests

#: Of the largest standard deviation: by such a reversal the spread of both directions together is wider
#: than that of either, whatever factor up to 3 a standard takes; but for rounding.
_WIDER_THAN_THE_SPREAD = 3.0 * (1 - 1e-9)


@dataclass(frozen=True, slots=True)
class WorkedExample:
    """A test and the parameters that it has, from the standard's own text or computed by hand.

    Attributes
    ----------
    measurements
        The test; `bidirectional_test` takes a table as it is printed.
    values
        The parameters by their symbols, each in its unit: µm, ″, or that of its quantity.
    keys
        The job keys with which they hold, beside those that all checks are run with.
    tolerance
        What the printed digits leave open: half a unit of the last one.
    """

    measurements: MeasurementSet
    values: Mapping[str, float]
    keys: Mapping[str, Any] = field(default_factory=dict)
    tolerance: float = 5e-4


@check
def gives_the_worked_values(
    standard: Standard, options: Options, examples: Sequence[WorkedExample] = (), *_: Any
) -> None:
    """Check that the parameters of worked examples are those that their author states."""
    expect(
        examples,
        f"{standard.identifier}: give a worked example: check_standard(…, examples=[WorkedExample(test, "
        "{symbol: value})]), from the standard's text or computed by hand; nobody else can see a wrong "
        "factor or a term that was left out",
    )
    _expect_telling(standard, options, examples)
    for number, example in enumerate(examples, start=1):
        where = f"{standard.identifier}: worked example {number}"
        one = _make_for(standard, example.measurements)
        found = evaluate(one, example.measurements, _replace_keys(options, example.keys), {})
        usual = example.measurements.axis.deviation_unit
        known = {quantity.symbol: quantity for quantity in one.quantities}
        for symbol, stated in example.values.items():
            expect(symbol in known, f"{where}: {symbol} is no parameter of it; it has {', '.join(known)}")
            value, unit = found.value(symbol), known[symbol].unit_or(usual)
            expect(value is not None, f"{where}: {symbol} is not defined; the example has {stated:g}")
            shown = unit.from_si(value or 0.0)
            expect(
                abs(shown - stated) <= example.tolerance * (1 + 1e-6),
                f"{where}: {symbol} is {shown:.6g} {unit.symbol}; the example has {stated:g} (a wrong "
                "factor, or a term that was left out)",
            )


def _expect_telling(standard: Standard, options: Options, examples: Sequence[WorkedExample]) -> None:
    """Expect examples whose values the usual mistakes would change."""
    where = f"{standard.identifier}: worked examples"
    telling = [
        example
        for example in examples
        if _is_over_time(example.measurements) or _has_wide_reversal(example.measurements)
    ]
    expect(
        telling,
        f"{where}: in one of them a reversal must be wider than the readings scatter (3 s), so that a "
        "reversal that was left out shows",
    )
    stated = {symbol for each in telling for symbol, value in each.values.items() if value}
    missing = [
        each.symbol
        for each in standard.quantities
        if each.symbol not in stated | _find_zero(standard, options)
    ]
    expect(
        not missing,
        f"{where}: where a reversal is wider than the readings scatter they state no value, other than "
        f"zero, of {', '.join(missing)}",
    )
    if any(quantity.group is QuantityGroup.RANDOM for quantity in standard.quantities):
        expect(
            any(scatter > 0 for each in telling for _, scatter in _measure_spreads(each.measurements)),
            f"{where}: in one of them readings must scatter, so that a wrong factor of s shows",
        )


def _find_zero(standard: Standard, options: Options) -> set[str]:
    """Return the symbols of what is zero by definition, as both ends of a line that goes through them."""
    return {
        symbol
        for each in good_tests(standard).values()
        for symbol, value in standard.arithmetic(compute_statistics_of(each), options).parameters.items()
        if np.all(np.equal(value, 0.0))
    }


def _is_over_time(measurements: MeasurementSet) -> bool:
    """Return whether nothing moved: what is read over hours has one direction only."""
    return all(line.axis.measurand.coordinate is Coordinate.TIME for line in measurements.lines)


def _has_wide_reversal(measurements: MeasurementSet) -> bool:
    return any(0 < reversal >= _WIDER_THAN_THE_SPREAD * s for reversal, s in _measure_spreads(measurements))


def _measure_spreads(measurements: MeasurementSet) -> Iterator[tuple[float, float]]:
    """Yield the widest reversal and the largest standard deviation of each line, m or rad."""
    for line in measurements.lines:
        statistics = compute_statistics_of(line)
        up, down = statistics.mean_positive, statistics.mean_negative
        reversal = np.abs(up - down)
        if np.all(np.isnan(reversal)) and not (np.all(np.isnan(up)) or np.all(np.isnan(down))):
            reversal = np.abs(np.atleast_1d(np.nanmean(up) - np.nanmean(down)))  # at other targets each
        scatter = np.stack([statistics.s_positive, statistics.s_negative])
        yield _find_largest(reversal), _find_largest(scatter)


def _find_largest(values: FloatArray) -> float:
    return float(np.max(values, initial=0.0, where=~np.isnan(values)))


@check
def every_key_matters(
    standard: Standard,
    options: Options,
    examples: Sequence[WorkedExample] = (),
    other_keys: Mapping[str, Any] | None = None,
) -> None:
    """Check that another value of each job key changes something of the result, on some test."""
    stated = other_keys or {}
    tests = [
        *(each.measurements for each in examples),
        *good_tests(standard).values(),
        *poor_tests(standard).values(),
    ]
    for key in type(options).model_fields:
        where = f"{standard.identifier}: job key '{key}'"
        values = [stated[key]] if key in stated else list(_list_others(options, key))
        others = [other for value in values if (other := _change_options(options, key, value)) is not None]
        expect(
            others,
            f"{where}: the kit finds no other value for it; state one that changes a result: "
            f"check_standard(…, other_keys={{{key!r}: …}})",
        )
        expect(
            any(
                not is_same_value(
                    _collect_outcome(standard, test, options), _collect_outcome(standard, test, other)
                )
                for test in tests
                for other in others
            ),
            f"{where} is ignored: {' or '.join(repr(getattr(each, key)) for each in others)} gives what "
            f"{getattr(options, key)!r} gives",
        )


def _collect_outcome(standard: Standard, measurements: MeasurementSet, options: Options) -> tuple[Any, ...]:
    """Return all that a standard says of a test."""
    one = _make_for(standard, measurements)
    found = evaluate(one, measurements, options, {})
    values = [(each.quantity.symbol, each.value) for each in found.parameters]
    columns, figures = [each.values for each in found.columns], list(one.figures(found, options))
    of_lines = find_contributions_of(one, measurements, options) if measurements.tests else {}
    return values, columns, found.findings, figures, of_lines


def _make_for(standard: Standard, measurements: MeasurementSet) -> Standard:
    axis = measurements.axis
    return evaluate_for_error(standard, axis.error or (axis.quantity.identifier if axis.quantity else ""))


def _list_others(options: Options, key: str) -> Iterator[Any]:
    """Yield other values of a key, as far as its type tells some."""
    value = getattr(options, key)
    annotation = type(options).model_fields[key].annotation
    for each in (annotation, *get_args(annotation)):
        kind = get_args(each)[0] if get_origin(each) is Annotated else each
        if get_origin(kind) is Literal:
            yield from (other for other in get_args(kind) if other != value)
        elif kind is bool:
            yield not value
        elif isinstance(kind, type) and issubclass(kind, Enum):
            yield from (other for other in kind if other is not value)
        elif kind in {int, float}:
            size = 1 if value is None else value
            yield from (2 * size + 1, size + 1, size - 1, *([size / 2] if kind is float else []))


def _replace_keys(options: Options, keys: Mapping[str, Any]) -> Options:
    stated = {key: getattr(options, key) for key in options.model_fields_set}
    return type(options).model_validate({**stated, **keys})


def _change_options(options: Options, key: str, value: Any) -> Options | None:
    """Return options with another value of a key; None where the standard does not take it."""
    try:
        return _replace_keys(options, {key: value})
    except ValidationError:
        return None


#: What only an author's own numbers show, each called with them beside the standard and its options.
EXAMPLE_CHECKS = list_checks_of(__name__)
