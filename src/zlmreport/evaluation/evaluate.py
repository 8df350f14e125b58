"""From a measurement set and a standard to an evaluation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Protocol

import numpy as np

from zlmreport.evaluation.evaluation import Arithmetic, Evaluation, Parameter, PositionColumn
from zlmreport.evaluation.quantity import PositionQuantity, Quantity
from zlmreport.evaluation.requirements import Finding
from zlmreport.evaluation.statistics import PositionStatistics, position_statistics
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet


class EvaluatingStandard(Protocol):
    """The part of a standard that evaluation needs (the whole: `zlmreport.protocols.Standard`)."""

    identifier: str
    designation: str
    title: Words
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
    *,
    decides_without_uncertainty: bool = True,
) -> Evaluation:
    """Evaluate one test by one standard.

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
    decides_without_uncertainty
        Whether the decision rule compares the bare value with the limit (simple acceptance). A rule that
        needs the uncertainty of a parameter leaves the verdict open where there is none.
    """
    statistics = position_statistics(measurements.deviations())
    arithmetic = standard.arithmetic(statistics, options)
    parameters = []
    for quantity in standard.quantities:
        value = float(arithmetic.parameters[quantity.symbol])
        if np.isnan(value):
            continue
        limit = tolerances.get(quantity.symbol)
        conforms = None
        if limit is not None and decides_without_uncertainty:
            conforms = abs(value) <= limit
        parameters.append(Parameter(quantity, value, limit, conforms))
    columns = tuple(
        PositionColumn(quantity, arithmetic.positions[quantity.symbol])
        for quantity in standard.position_quantities
    )
    return Evaluation(
        standard=standard.identifier,
        designation=standard.designation,
        title=standard.title,
        measurements=measurements,
        statistics=statistics,
        parameters=tuple(parameters),
        columns=columns,
        findings=tuple(standard.requirements(measurements, options)),
        notes=standard.notes,
    )
