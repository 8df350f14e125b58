"""The fit against the reference datasets of NIST: how many of the certified digits it reaches."""

from __future__ import annotations

import numpy as np
import pytest

from model.reference_datasets import NONLINEAR, Dataset, Function, Predictors, dataset
from zlmreport.model.axis_model import AxisModel, Term
from zlmreport.model.effect import Effect
from zlmreport.model.fit import Assumptions, Fit, fit
from zlmreport.model.spread import Spread
from zlmreport.quantities.arrays import FloatArray

INDEPENDENT = Assumptions(parts=(), spread=Spread.POOLED)

#: Polynomials by their order; None for a regression on several predictors. Certified are 15 digits.
LINEAR = {
    "Norris": (1, 12),
    "Pontius": (2, 12),
    "Longley": (None, 11),
    "Wampler1": (5, 9),
    "Wampler2": (5, 12),
    "Wampler3": (5, 9),
    "Wampler4": (5, 7),
    "Wampler5": (5, 5),
    "Filip": (10, 7),
}
#: Certified are 11 digits.
DIGITS = {"Thurber": 7, "MGH09": 6, "Lanczos3": 8, "DanWood": 9, "BoxBOD": 9}


def _fit(found: Dataset, effect: Effect) -> Fit:
    return fit(AxisModel((Term(effect),)), found.design, found.values, INDEPENDENT)


def _polynomial(order: int | None) -> Effect:
    if order is None:
        return Predictors(6)
    return Function(lambda x, _: [x**power for power in range(order + 1)], order + 1)


def _agree(found: FloatArray, certified: FloatArray, digits: int) -> None:
    tolerance = 10.0**-digits
    assert found == pytest.approx(certified, rel=tolerance, abs=tolerance if not certified.any() else 0)


@pytest.mark.parametrize(("name", "order", "digits"), [(name, *each) for name, each in LINEAR.items()])
def test_linear_parameters(name: str, order: int | None, digits: int) -> None:
    found = dataset(name)
    _agree(_fit(found, _polynomial(order)).solution.coefficients[0], found.parameters, digits)


@pytest.mark.parametrize("name", [name for name in LINEAR if name not in {"Wampler1", "Wampler2"}])
def test_standard_deviations_of_linear_parameters(name: str) -> None:
    found = dataset(name)
    fitted = _fit(found, _polynomial(LINEAR[name][0]))
    _agree(np.array([each.standard_uncertainty for each in fitted.estimates]), found.standard_deviations, 7)


@pytest.mark.parametrize("name", NONLINEAR)
def test_nonlinear_parameters(name: str) -> None:
    found, wanted = dataset(name), NONLINEAR[name]
    solution = _fit(found, wanted.effect).solution
    values = wanted.back(solution.coefficients[0], solution.thetas[0])
    _agree(np.array(values), found.parameters, DIGITS.get(name, 10))


@pytest.mark.parametrize("name", NONLINEAR)
def test_residual_standard_deviation(name: str) -> None:
    found = dataset(name)
    fitted = _fit(found, NONLINEAR[name].effect)
    _agree(np.array([fitted.rms]), np.array([found.residual_standard_deviation]), 10)


@pytest.mark.parametrize("name", ["Misra1a", "Misra1b", "BoxBOD", "DanWood", "Rat42", "MGH10", "MGH17"])
def test_standard_deviations_of_nonlinear_parameters(name: str) -> None:
    found = dataset(name)
    fitted = _fit(found, NONLINEAR[name].effect)
    _agree(np.array([each.standard_uncertainty for each in fitted.estimates]), found.standard_deviations, 6)
