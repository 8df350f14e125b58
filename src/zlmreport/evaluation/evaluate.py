"""From a measurement set and a standard to an evaluation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Protocol

import numpy as np

from zlmreport.evaluation.evaluation import Arithmetic, Evaluation, Parameter, PositionColumn
from zlmreport.evaluation.plausibility import doubts
from zlmreport.evaluation.quantity import PositionQuantity, Quantity
from zlmreport.evaluation.requirements import Finding
from zlmreport.evaluation.statistics import PositionStatistics, position_statistics
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.arrays import read_only_floats
from zlmreport.quantities.notation import plain


class EvaluatingStandard(Protocol):
    """The part of a standard that evaluation needs (the whole: `zlmreport.plugin.protocols.Standard`)."""

    identifier: str
    designation: str
    title: Words
    position_index: str
    quantities: tuple[Quantity, ...]
    position_quantities: tuple[PositionQuantity, ...]
    notes: tuple[Words, ...]

    def requirements(self, measurements: MeasurementSet, options: Any) -> Iterable[Finding]:
        """Hold the standard's requirements against the test."""

    def arithmetic(self, statistics: PositionStatistics, options: Any) -> Arithmetic:
        """Return the standard's parameters and columns, with the batch dimensions of the statistics."""


def evaluate(
    standard: EvaluatingStandard,
    measurements: MeasurementSet,
    options: Any,
    tolerances: Mapping[str, float],
) -> Evaluation:
    """Evaluate one test by one standard; nothing is decided on its limits yet (`decision.decided`).

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
    statistics = position_statistics(measurements.deviations())
    arithmetic = standard.arithmetic(statistics, options)
    parameters = []
    undefined = []
    for quantity in standard.quantities:
        value = float(arithmetic.parameters[quantity.symbol])
        limit = tolerances.get(quantity.symbol)
        if np.isnan(value):
            if limit is not None:
                undefined.append(_undefined(quantity))
            continue
        parameters.append(Parameter(quantity, value, limit))
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
            *undefined,
            *doubts(((each.quantity, each.value) for each in parameters), statistics, measurements.axis),
        ),
        notes=standard.notes,
    )


def _undefined(quantity: Quantity) -> Finding:
    """Return the finding on a limit that is stated for a parameter which the test does not define."""
    requirement = Words(
        "A test that defines {symbol}, for which a limit is stated",
        "Eine Messung, die {symbol} bestimmt: dafür ist ein Grenzwert angegeben",
    )
    found = Words(
        "{symbol} is not defined by this test; nothing is decided on its limit",
        "{symbol} ist durch diese Messung nicht bestimmt; über den Grenzwert wird nicht entschieden",
    )
    symbol = plain(quantity.notation)
    return Finding(requirement.given(symbol=symbol), found.given(symbol=symbol), met=False)
