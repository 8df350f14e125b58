"""Evaluations with the uncertainty of everything that they state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.uncertainty.budget import Budget, NoBudget
from zlmreport.uncertainty.monte_carlo import StandardArithmetic, propagate
from zlmreport.uncertainty.positions import mean_uncertainty


def with_uncertainty(
    evaluations: Sequence[tuple[Evaluation, StandardArithmetic]], budget: Budget | NoBudget
) -> tuple[Evaluation, ...]:
    """Return evaluations of one test with U and k of their parameters and U of their mean deviations.

    Parameters
    ----------
    evaluations
        Each with the arithmetic that takes it from statistics to parameters.
    budget
        Of the measuring set-up; without one, the evaluations come back as they are.
    """
    bare = tuple(evaluation for evaluation, _ in evaluations)
    if isinstance(budget, NoBudget) or not bare:
        return bare
    found = []
    for evaluation, expanded in zip(bare, propagate(budget, evaluations), strict=True):
        parameters = tuple(
            replace(
                each,
                expanded_uncertainty=expanded[each.quantity.symbol].uncertainty,
                coverage_factor=expanded[each.quantity.symbol].coverage_factor,
            )
            for each in evaluation.parameters
        )
        means = mean_uncertainty(evaluation, budget)
        found.append(replace(evaluation, parameters=parameters, mean_uncertainty=means))
    return tuple(found)
