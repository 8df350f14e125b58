"""An evaluation as the results file states it: full precision, micrometres or ″, symbols in ASCII.

What a test does not define is absent: there is no NaN, and no zero in its place.
"""

from __future__ import annotations

import math
from typing import Any

from zlmreport.evaluation.evaluation import Decision, EvaluatedParameter, Evaluation, compare_parameters
from zlmreport.language import Language
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import Unit

#: How directions of approach are called in symbols.
DIRECTIONS = {Approach.POSITIVE: "fwd", Approach.NEGATIVE: "bwd"}


def report_evaluation(evaluation: Evaluation, language: Language = Language.ENGLISH) -> dict[str, Any]:
    """Return an evaluation as plain values: parameters, positions, findings.

    Parameters
    ----------
    evaluation
        The evaluation.
    language
        Of names and sentences; symbols are the same in every language.
    """
    unit = evaluation.measurements.axis.deviation_unit
    return {
        "standard": evaluation.standard,
        "designation": evaluation.designation,
        "parameters": [report_parameter(each, unit, language) for each in evaluation.parameters],
        "positions": [
            _collect_position(evaluation, index)
            for index in range(len(evaluation.measurements.target_positions))
        ],
        "findings": [
            {
                "requirement": finding.requirement.in_language(language),
                "found": finding.found.in_language(language),
                "met": finding.met,
                "basis": finding.basis.value,
            }
            for finding in evaluation.findings
        ],
    }


def report_changes(before: Evaluation, after: Evaluation) -> dict[str, Any]:
    """Return by how much each parameter changed from one test to another, with U where both are known."""
    unit = after.measurements.axis.deviation_unit
    return {
        "standard": after.standard,
        "parameters": [
            {
                "symbol": each.either.quantity.symbol,
                "value": each.either.quantity.unit_or(unit).from_si(each.value),
                "unit": each.either.quantity.unit_or(unit).ascii,
                **_collect_expanded(each.expanded_uncertainty, each.either.quantity.unit_or(unit)),
            }
            for each in compare_parameters(before, after)
            if each.value is not None
        ],
    }


def _collect_expanded(uncertainty: float | None, unit: Unit) -> dict[str, float]:
    return {} if uncertainty is None else {"expanded_uncertainty": unit.from_si(uncertainty)}


def report_parameter(parameter: EvaluatedParameter, unit: Unit, language: Language) -> dict[str, Any]:
    """Return a parameter with its uncertainty, its limit and what is decided on it."""
    unit = parameter.quantity.unit_or(unit)
    values: dict[str, Any] = {
        "symbol": parameter.quantity.symbol,
        "name": parameter.quantity.name.in_language(language),
        "value": unit.from_si(parameter.value),
        "unit": unit.ascii,
        **_collect_expanded(parameter.expanded_uncertainty, unit),
    }
    if parameter.coverage_factor is not None:
        values["coverage_factor"] = parameter.coverage_factor
    if parameter.known_error:
        values["known_error"] = unit.from_si(parameter.known_error)
    if parameter.raised_to is not None:
        values["raised_to"] = parameter.raised_to.value
    if parameter.axis_interval is not None:
        values["axis_interval"] = [unit.from_si(end) for end in parameter.axis_interval]
    if parameter.limit is not None:
        values["limit"] = unit.from_si(parameter.limit)
        values["conforms"] = parameter.conforms
    if parameter.decision is not None:
        values["decision"] = _collect_decision(parameter.decision, unit)
    return values


def _collect_decision(decision: Decision, unit: Unit) -> dict[str, Any]:
    stated: dict[str, Any] = {"statement": decision.conformity.value}
    if decision.acceptance_limit is not None:
        stated["acceptance_limit"] = unit.from_si(decision.acceptance_limit)
    if decision.rejection_limit is not None:
        stated["rejection_limit"] = unit.from_si(decision.rejection_limit)
    if decision.risk is not None:
        stated["risk"] = decision.risk
    return stated


def _collect_position(evaluation: Evaluation, index: int) -> dict[str, Any]:
    measurements = evaluation.measurements
    statistics = evaluation.statistics
    row: dict[str, Any] = {"target": measurements.axis.typed(float(measurements.target_positions[index]))}
    for approach in measurements.approaches:
        row[f"n_{DIRECTIONS[approach]}"] = int(statistics.count[approach.index, index])
    for symbol, values in collect_position_columns(evaluation).items():
        value = float(values[index])
        if not math.isnan(value):
            row[symbol] = measurements.axis.deviation_unit.from_si(value)
    return row


def collect_position_columns(evaluation: Evaluation) -> dict[str, FloatArray]:
    """Return the columns of the table by position, shape (m,), m or rad; NaN where not defined."""
    statistics, expanded = evaluation.statistics, evaluation.mean_uncertainty
    columns = {
        "mean_fwd": statistics.mean_positive,
        "mean_bwd": statistics.mean_negative,
        "mean": statistics.mean_bidirectional,
        "s_fwd": statistics.s_positive,
        "s_bwd": statistics.s_negative,
        "reversal": statistics.reversal_value,
        **{column.quantity.symbol: column.values for column in evaluation.columns},
    }
    if expanded is not None:
        columns |= {
            "U_mean_fwd": expanded.by_approach[Approach.POSITIVE.index],
            "U_mean_bwd": expanded.by_approach[Approach.NEGATIVE.index],
            "U_mean": expanded.bidirectional,
        }
    return columns
