"""Evaluates a measurement set by a standard, and doubts values that its readings cannot give."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.evaluation.checks import deviation_in_words
from zlmreport.evaluation.evaluation import (
    EvaluatedParameter,
    Evaluation,
    Finding,
    PositionColumn,
    Quantity,
    QuantityGroup,
)
from zlmreport.evaluation.statistics import PositionStatistics, compute_statistics_of
from zlmreport.language import Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet

if TYPE_CHECKING:
    from zlmreport.plugin.protocols import Standard

_IDENTICAL = Words("{adoption} is identical to {standard}.")


def evaluate(
    standard: Standard,
    measurements: MeasurementSet,
    options: Any,
    tolerances: Mapping[str, float],
) -> Evaluation:
    """Evaluate one test by one standard; nothing is decided on its limits yet.

    Parameters
    ----------
    standard
        Any installed standard.
    measurements
        The test.
    options
        The standard's own job keys, as its options class validated them.
    tolerances : mapping of symbol to limit
        m or rad.
    """
    statistics = compute_statistics_of(measurements)
    arithmetic = standard.arithmetic(statistics, options)
    parameters = []
    undefined = []
    for quantity in standard.quantities:
        value = float(arithmetic.parameters[quantity.symbol])
        limit = tolerances.get(quantity.symbol)
        if np.isnan(value):
            if limit is not None:
                undefined.append(quantity)
            continue
        parameters.append(EvaluatedParameter(quantity, value, limit))
    columns = tuple(
        PositionColumn(quantity, read_only_floats(arithmetic.positions[quantity.symbol]))
        for quantity in standard.position_quantities
    )
    return Evaluation(
        standard=standard.identifier,
        designation=standard.designation,
        title=standard.title,
        position_index=standard.position_index,
        measurements=measurements,
        statistics=statistics,
        parameters=tuple(parameters),
        columns=columns,
        findings=(
            *standard.requirements(measurements, options),
            *map(_report_undefined, undefined),
            *find_doubts(((each.quantity, each.value) for each in parameters), statistics, measurements.axis),
        ),
        notes=_select_notes(standard, measurements, frozenset(each.quantity.symbol for each in parameters)),
        is_method=getattr(standard, "is_method", False),
        undefined=tuple(each.symbol for each in undefined),
    )


def name_adoption(evaluation: Evaluation, adoption: str) -> Evaluation:
    """Return an evaluation that names, beside its standard, the identical adoption that was asked for."""
    note = _IDENTICAL.given(adoption=adoption, standard=evaluation.designation)
    designation = f"{evaluation.designation} ({adoption})"
    return replace(evaluation, designation=designation, notes=(note, *evaluation.notes))


def _select_notes(
    standard: Standard, measurements: MeasurementSet, reported: frozenset[str]
) -> tuple[Words, ...]:
    """Return the notes of a standard without those on parameters of which the test reports none.

    A standard whose formulas join both directions may have others of a test in one of them.
    """
    idle = [note for symbols, note in getattr(standard, "notes_on", ()) if reported.isdisjoint(symbols)]
    of_one = getattr(standard, "notes_of_one_direction", ())
    notes = of_one if of_one and len(measurements.approaches) == 1 else standard.notes
    return tuple(each for each in notes if each not in idle)


def _report_undefined(quantity: Quantity) -> Finding:
    """Return the finding on a limit that is stated for a parameter which the test does not define."""
    requirement = Words("A test that defines {symbol}, for which a limit is stated")
    found = Words("{symbol} is not defined by this test; nothing is decided on its limit")
    symbol = write_plain(quantity.notation)
    return Finding(requirement.given(symbol=symbol), found.given(symbol=symbol), met=False)


#: No parameter is larger than this many times the largest deviation and the range of all: of two runs s is at
#: most 0.71 of the range, so A = range + 4 s is below 4 of them, and 3 s on both sides below 6.
_FARTHEST = 20.0

_POSSIBLE = Words("A value of {symbol} that these readings can give")
_NEGATIVE = Words(
    "{value}: not plausible, {symbol} cannot be negative; the formulas of the plugin are in doubt"
)
_TOO_LARGE = Words(
    "{value}: not plausible, no reading deviates by more than {largest}; the formulas of the plugin are in "
    "doubt"
)


def measure_reach(statistics: PositionStatistics) -> float:
    """Return what no parameter of a test exceeds, m or rad; NaN without readings."""
    readings = statistics.deviations[~np.isnan(statistics.deviations)]
    if not readings.size:
        return math.nan
    return _FARTHEST * float(np.abs(readings).max() + np.ptp(readings))


def is_negative(quantity: Quantity, value: float, farthest: float) -> bool:
    """Return whether a value is negative, beyond rounding, that is a spread or a range."""
    return quantity.group is not QuantityGroup.SYSTEMATIC and value < -1e-9 * farthest


def find_doubts(
    values: Iterable[tuple[Quantity, float]], statistics: PositionStatistics, axis: Axis
) -> Iterator[Finding]:
    """Yield a finding on each value that is not plausible: wrong units and signs in a plugin's formulas show.

    `values`: Parameters with their values, m or rad; none of them NaN.
    """
    if statistics.tests:
        return  # what several lines give together may be of another kind than any of their readings
    farthest = measure_reach(statistics)
    for quantity, value in values:
        negative = is_negative(quantity, value, farthest)
        if not negative and abs(value) <= farthest:
            continue
        if quantity.unit is not None:
            continue  # of another unit than the readings: their reach says nothing of it
        symbol, said = write_plain(quantity.notation), deviation_in_words(axis, value)
        largest = deviation_in_words(axis, float(np.nanmax(np.abs(statistics.deviations))))
        found = (_NEGATIVE if negative else _TOO_LARGE).given(symbol=symbol, value=said, largest=largest)
        yield Finding(_POSSIBLE.given(symbol=symbol), found, met=False)
