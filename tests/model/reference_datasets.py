"""The reference datasets of NIST as effects: each nonlinear function in the form that is linear in part."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from zlmreport.plugin import Axis, FloatArray, same_in_all_languages as same
from zlmreport.plugin.effect import Design, Dimension, Effect, Parameter, Shape

_FILE = Path(__file__).parents[1] / "data" / "nist" / "reference_datasets.json"

Columns = Callable[[FloatArray, FloatArray], Sequence[FloatArray]]
#: From γ and θ to the parameters as NIST writes them.
Back = Callable[[FloatArray, FloatArray], Sequence[float]]


@dataclass(frozen=True)
class Dataset:
    """A dataset with its certified values."""

    name: str
    design: Design
    values: FloatArray
    parameters: FloatArray
    standard_deviations: FloatArray
    residual_standard_deviation: float


def dataset(name: str) -> Dataset:
    """Return a dataset as it is printed."""
    found = json.loads(_FILE.read_text(encoding="utf-8"))["sets"][name]
    predictors = np.array(found["x"], dtype=np.float64)
    values = np.array(found["y"], dtype=np.float64)
    parameters = np.array(found["parameters"], dtype=np.float64)
    if "residual_standard_deviation" in found:
        deviation = float(found["residual_standard_deviation"])
    else:
        squares = float(found["residual_sum_of_squares"])
        deviation = float(np.sqrt(squares / (len(values) - len(parameters))))
    columns = predictors.reshape(len(values), -1)
    count = np.arange(len(values))
    design = Design(
        axis=Axis("X"),
        position=columns[:, 0],
        direction=np.ones(len(values)),
        run=np.ones(len(values), dtype=np.int64),
        target=count,
        time=count.astype(np.float64),
        time_is_counted=True,
        since_reversal=np.zeros(len(values)),
        conditions={f"x{index}": column for index, column in enumerate(columns.T)},
    )
    standard_deviations = np.array(found["standard_deviations"], dtype=np.float64)
    return Dataset(name, design, values, parameters, standard_deviations, deviation)


def _parameter(name: str) -> Parameter:
    return Parameter(name, name, Dimension.RATIO, same(name))


class Function(Effect):
    """A function of x that is linear in γ, and in θ not."""

    identifier = "function"
    title = same("function")
    equation = "Σ γ·f(x; θ)"
    shape = Shape.POSITION
    look = same("")

    def __init__(self, columns: Columns, linear: int, grid: Sequence[Sequence[float]] = ()) -> None:
        self._columns = columns
        self._grid = grid
        self.linear = tuple(_parameter(f"c{index}") for index in range(linear))
        self.searched = tuple(_parameter(f"t{index}") for index in range(len(grid)))

    def grid(self, design: Design) -> FloatArray:
        """Return every combination of the starting values."""
        if not self._grid:
            return super().grid(design)
        return np.stack(np.meshgrid(*self._grid, indexing="ij"), axis=-1).reshape(-1, len(self._grid))

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return the functions at x."""
        return np.stack(self._columns(design.position, theta), axis=1)


class Predictors(Effect):
    """A constant and every predictor: the linear datasets of several."""

    identifier = "predictors"
    title = same("predictors")
    equation = "Σ β·x"
    shape = Shape.POSITION
    look = same("")

    def __init__(self, count: int) -> None:
        self.linear = tuple(_parameter(f"b{index}") for index in range(count + 1))

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - nothing is searched
        """Return them."""
        return np.stack([np.ones(len(design.position)), *design.conditions.values()], axis=1)


@dataclass(frozen=True)
class Nonlinear:
    """A nonlinear dataset as an effect, and the way back to NIST's parameters."""

    effect: Function
    back: Back


def jacobian(back: Back, gamma: FloatArray, theta: FloatArray) -> FloatArray:
    """Return the derivatives of NIST's parameters by γ and θ, to the last digit: by imaginary steps."""
    place, step = np.concatenate([gamma, theta]).astype(np.complex128), 1e-30
    columns = []
    for index in range(len(place)):
        moved = place.copy()
        moved[index] += 1j * step
        columns.append(np.imag(np.array(back(moved[: len(gamma)], moved[len(gamma) :]))) / step)
    return np.stack(columns, axis=1)


def _polynomial(order: int) -> Function:
    return Function(lambda x, _: [x**power for power in range(order + 1)], order + 1)


LINEAR: Mapping[str, Effect] = {
    "Norris": _polynomial(1),
    "Pontius": _polynomial(2),
    "Longley": Predictors(6),
    **{f"Wampler{number}": _polynomial(5) for number in range(1, 6)},
    "Filip": _polynomial(10),
}


def _steps(least: float, most: float, count: int = 13) -> Sequence[float]:
    return list(np.geomspace(least, most, count))


def _eckerle(x: FloatArray, t: FloatArray) -> Sequence[FloatArray]:
    return [np.exp(-0.5 * ((x - t[1]) / t[0]) ** 2)]


def _thurber(x: FloatArray, t: FloatArray) -> Sequence[FloatArray]:
    below = 1 + t[0] * x + t[1] * x**2 + t[2] * x**3
    return [x**power / below for power in range(4)]


NONLINEAR = {
    "Misra1a": Nonlinear(
        Function(lambda x, t: [-np.expm1(-t[0] * x)], 1, [_steps(1e-5, 1e-2)]), lambda g, t: [g[0], t[0]]
    ),
    "Misra1b": Nonlinear(
        Function(lambda x, t: [1 - (1 + t[0] * x / 2) ** -2], 1, [_steps(1e-5, 1e-2)]),
        lambda g, t: [g[0], t[0]],
    ),
    "BoxBOD": Nonlinear(
        Function(lambda x, t: [-np.expm1(-t[0] * x)], 1, [_steps(1e-2, 1e1)]), lambda g, t: [g[0], t[0]]
    ),
    "DanWood": Nonlinear(
        Function(lambda x, t: [x ** t[0]], 1, [_steps(1.0, 10.0)]), lambda g, t: [g[0], t[0]]
    ),
    "Rat42": Nonlinear(
        Function(lambda x, t: [1 / (1 + np.exp(t[0] - t[1] * x))], 1, [_steps(0.5, 10), _steps(1e-2, 1.0)]),
        lambda g, t: [g[0], t[0], t[1]],
    ),
    "Eckerle4": Nonlinear(
        Function(_eckerle, 1, [_steps(1, 30), list(np.linspace(420, 480, 13))]),
        lambda g, t: [g[0] * t[0], t[0], t[1]],
    ),
    "MGH09": Nonlinear(
        Function(
            lambda x, t: [each / (x**2 + x * t[0] + t[1]) for each in (x**2, x)],
            2,
            [_steps(1e-2, 10), _steps(1e-2, 10)],
        ),
        lambda g, t: [g[0], g[1] / g[0], t[0], t[1]],
    ),
    "MGH10": Nonlinear(
        Function(lambda x, t: [np.exp(t[0] / (x + t[1]))], 1, [_steps(2000, 20_000), _steps(100, 1000)]),
        lambda g, t: [g[0], t[0], t[1]],
    ),
    "MGH17": Nonlinear(
        Function(
            lambda x, t: [np.ones_like(x), np.exp(-x * t[0]), np.exp(-x * t[1])],
            3,
            [_steps(5e-3, 0.0171, 9), _steps(0.0172, 0.1, 9)],
        ),
        lambda g, t: [*g, *t],
    ),
    "Thurber": Nonlinear(
        Function(_thurber, 4, [_steps(0.3, 2, 7), _steps(0.1, 1, 7), _steps(0.01, 0.2, 7)]),
        lambda g, t: [*g, *t],
    ),
    "Lanczos3": Nonlinear(
        Function(
            lambda x, t: [np.exp(-rate * x) for rate in t],
            3,
            [_steps(0.4, 1.6, 7), _steps(1.8, 4.0, 7), _steps(4.2, 8.0, 7)],
        ),
        lambda g, t: [g[0], t[0], g[1], t[1], g[2], t[2]],
    ),
}
