"""A search over kernels of a Gaussian process, built up by sums and products.

D. Duvenaud, J. R. Lloyd, R. Grosse, J. B. Tenenbaum and Z. Ghahramani, Proceedings of the 30th International
Conference on Machine Learning (2013) 1166. It needs scikit-learn, which nothing else in the project does:
where that is not installed, this way is left out.
"""

from __future__ import annotations

import time
import warnings
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from zlmreport.measurement.arrays import FloatArray

_DEPTH = 3


@dataclass(frozen=True, slots=True)
class Inputs:
    """What was recorded, of zero mean and unit spread over the first test.

    Attributes
    ----------
    names
        The variables.
    first, again : (N, v), (M, v) arrays
        Their values in the two tests.
    """

    names: tuple[str, ...]
    first: FloatArray
    again: FloatArray


@dataclass(frozen=True, slots=True)
class Found:
    """What the search found.

    Attributes
    ----------
    variables
        Those of its first component.
    fitted : (N,) array
        The mean of the process at the readings of the first test.
    predicted : (M,) array
        The same at those of the second.
    seconds
        Of the processor.
    """

    variables: frozenset[str]
    fitted: FloatArray
    predicted: FloatArray
    seconds: float


@dataclass(frozen=True, slots=True)
class _Structure:
    """A sum of products of base kernels, by their places in the list of base kernels."""

    products: tuple[tuple[int, ...], ...]

    def grown(self, count: int) -> list[_Structure]:
        """Return every structure of one more base kernel: added, or multiplied to one of the products."""
        found = [_Structure((*self.products, (kernel,))) for kernel in range(count)]
        for place, product in enumerate(self.products):
            for kernel in range(count):
                longer = (*product, kernel)
                others = (*self.products[:place], longer, *self.products[place + 1 :])
                found.append(_Structure(others))
        return found


def is_installed() -> bool:
    """Whether scikit-learn is there."""
    return find_spec("sklearn") is not None


def search(inputs: Inputs, residual: FloatArray) -> Found:
    """Return the best kernel by the Bayesian information criterion, after a greedy search.

    Parameters
    ----------
    inputs
        The variables.
    residual : (N,) array
        What the job's model leaves.
    """
    started = time.process_time()
    base = _base_kernels(inputs)
    scale = float(np.std(residual))
    best: tuple[float, _Structure, Any] | None = None
    structures = [_Structure(((kernel,),)) for kernel in range(len(base))]
    for _ in range(_DEPTH):
        fits = [(*_fitted(each, base, inputs.first, residual / scale), each) for each in structures]
        criterion, process, structure = min(fits, key=lambda each: each[0])
        if best is not None and criterion >= best[0]:
            break
        best = criterion, structure, process
        structures = structure.grown(len(base))
    assert best is not None  # the first level always is better than nothing
    variables = frozenset(inputs.names[base[kernel][1]] for kernel in best[1].products[0])
    return Found(
        variables,
        scale * best[2].predict(inputs.first),
        scale * best[2].predict(inputs.again),
        time.process_time() - started,
    )


def _base_kernels(inputs: Inputs) -> list[tuple[Any, int]]:
    """Return smooth and straight kernels of every variable, and periodic ones of position and time."""
    from sklearn.gaussian_process.kernels import RBF, DotProduct, ExpSineSquared  # noqa: PLC0415

    smooth, straight, periodic = (_of_one_variable(each) for each in (RBF, DotProduct, ExpSineSquared))
    found = []
    for place, name in enumerate(inputs.names):
        found.append((straight(dimension=place), place))
        if name != "d":
            found.append((smooth(dimension=place), place))
        if name in ("P", "t"):
            found.append((periodic(dimension=place, periodicity=0.5), place))
    return found


def _of_one_variable(kernel: type[Any]) -> type[Any]:
    """Return a kernel that sees one variable only."""

    class OfOneVariable(kernel):  # type: ignore[misc]
        def __init__(self, dimension: int = 0, **parameters: Any) -> None:
            super().__init__(**parameters)
            self.dimension = dimension

        def get_params(self, deep: bool = True) -> dict[str, Any]:  # noqa: FBT001, FBT002 - scikit-learn's signature
            del deep
            names = kernel().get_params()
            return {"dimension": self.dimension, **{name: getattr(self, name) for name in names}}

        def __call__(self, X: FloatArray, Y: FloatArray | None = None, eval_gradient: bool = False) -> Any:  # noqa: FBT001, FBT002, N803 - scikit-learn's signature
            chosen = [self.dimension]
            return super().__call__(X[:, chosen], None if Y is None else Y[:, chosen], eval_gradient)

        def diag(self, X: FloatArray) -> Any:  # noqa: N803 - scikit-learn's signature
            return super().diag(X[:, [self.dimension]])

    return OfOneVariable


def _fitted(
    structure: _Structure, base: list[tuple[Any, int]], inputs: FloatArray, goal: FloatArray
) -> tuple[float, Any]:
    from sklearn.gaussian_process import GaussianProcessRegressor  # noqa: PLC0415
    from sklearn.gaussian_process.kernels import ConstantKernel, WhiteKernel  # noqa: PLC0415

    kernel = WhiteKernel(0.3)
    for product in structure.products:
        term = ConstantKernel(0.5)
        for factor in product:
            term = term * base[factor][0].clone_with_theta(base[factor][0].theta)
        kernel = kernel + term
    process = GaussianProcessRegressor(kernel, alpha=1e-8)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of hyperparameters at their bounds: the search goes on without them
        process.fit(inputs, goal)
    price = len(process.kernel_.theta) * np.log(len(goal))
    return float(price - 2 * process.log_marginal_likelihood_value_), process
