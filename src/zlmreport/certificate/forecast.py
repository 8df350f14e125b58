"""What a standard would say of the axis if its control corrected what the error model explains."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.compensation.basis import FittedModel, compensated
from zlmreport.evaluation.evaluation import Group, Quantity
from zlmreport.evaluation.statistics import position_statistics
from zlmreport.model.study import Fitted, Study, corrected
from zlmreport.quantities.arrays import FloatArray, read_only_floats

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluate import EvaluatingStandard
    from zlmreport.quantities.units import Unit

_ORDER = (Group.COMPOSITE, Group.SYSTEMATIC, Group.RANDOM)


@dataclass(frozen=True, slots=True)
class Forecast:
    """The leading parameters of a standard, predicted for a corrected axis."""

    #: standard and designation: Identifier and as printed.
    standard: str
    designation: str
    unit: Unit  #: In which deviations are printed.
    quantities: tuple[Quantity, ...]  #: The first parameter of each group: composite, systematic, random.
    #: (steps, quantities): After each step of the model's history, m or rad; the first row is of the readings
    #: as they are. NaN for what the test does not define.
    by_step: FloatArray
    by_table: FloatArray  #: (quantities,): With a table of the model, its rows at the targets, m or rad.


def forecasts(
    standards: Iterable[tuple[EvaluatingStandard, Any]], study: Study, history: Sequence[Fitted]
) -> tuple[Forecast, ...]:
    """Return the forecast by each standard."""
    tests = [corrected(study.measurements, study.observed, each.fit) for each in history]
    tests.append(compensated(FittedModel(study.measurements, study.observed, history[-1].fit)))
    statistics = position_statistics(np.stack([test.deviations() for test in tests]))
    found = []
    for standard, options in standards:
        values = standard.arithmetic(statistics, options).parameters
        quantities = _leading(standard.quantities)
        table = np.stack([values[quantity.symbol] for quantity in quantities], axis=1)
        found.append(
            Forecast(
                standard.identifier,
                standard.designation,
                study.measurements.axis.deviation_unit,
                quantities,
                read_only_floats(table[:-1]),
                read_only_floats(table[-1]),
            )
        )
    return tuple(found)


def _leading(quantities: Sequence[Quantity]) -> tuple[Quantity, ...]:
    """Return the first quantity of each group."""
    first: dict[Group, Quantity] = {}
    for quantity in quantities:
        first.setdefault(quantity.group, quantity)
    return tuple(first[group] for group in _ORDER if group in first)
