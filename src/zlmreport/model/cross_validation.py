"""The error of prediction: every run predicted from the others."""

from __future__ import annotations

import numpy as np

from zlmreport.model.axis_model import AxisModel
from zlmreport.model.design import Design
from zlmreport.model.observe import of_readings
from zlmreport.model.search import Problem, Thetas, refine
from zlmreport.quantities.arrays import FloatArray


def cross_validated_rms(
    model: AxisModel, design: Design, deviation: FloatArray, thetas: Thetas
) -> float | None:
    """Return the root mean square error of runs that were left out; None if there is a single run.

    What depends on position alone is repeated in every run, so this number is too kind to it. It is one to
    watch, not one to rank by.

    Parameters
    ----------
    model, design, deviation
        What is fitted to what.
    thetas
        Searched parameters of the whole test; refined anew without each run.
    """
    runs = np.unique(design.run)
    if len(runs) < 2:
        return None
    squares = 0.0
    for run in runs:
        left_out = np.flatnonzero(design.run == run)
        kept = np.flatnonzero(design.run != run)
        problem = Problem(model, of_readings(design, kept), deviation[kept], _as_they_are)
        found = refine(problem, problem.solution(thetas))
        others = of_readings(design, left_out)
        predicted = np.zeros(len(left_out))
        for term, theta, gamma in zip(model.terms, found.thetas, found.coefficients, strict=True):
            predicted += term.effect.columns(others, theta) @ gamma
        squares += float(np.sum((deviation[left_out] - predicted) ** 2))
    return float(np.sqrt(squares / len(deviation)))


def _as_they_are(columns: FloatArray) -> FloatArray:
    return columns
