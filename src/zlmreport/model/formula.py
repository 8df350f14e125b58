"""Effects that a job writes as a formula, without Python."""

from __future__ import annotations

from itertools import product

import numpy as np

from zlmreport.job.formula_keys import Formula, FormulaKeys
from zlmreport.language import Words, same
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.model.design import Design
from zlmreport.model.effect import Dimension, Effect, Parameter, Shape, needs_logged, unit_of
from zlmreport.quantities.arrays import FloatArray

#: Values of searched parameters that are tried: at most all together, of one alone, in each of its periods.
_MOST, _FEWEST, _PER_PERIOD = 400, 12, 4
_STATED = Words(
    en="stated where the formula is written; no standard states them",
    de="dort angegeben, wo die Formel steht; keine Norm nennt sie",
)
_LOOK = Words(en="The residuals follow {formula}.", de="Die Residuen folgen {formula}.")
_MEANING = Words(en="parameter of {formula}", de="Parameter von {formula}")


class FormulaEffect(Effect):
    """An effect that is written as a formula in a file.

    Parameters
    ----------
    keys
        As the file says it.
    kind
        Of the axis.

    Raises
    ------
    FormulaError
        If it cannot be meant for an axis of this kind.
    """

    ranges_from = _STATED

    def __init__(self, keys: FormulaKeys, kind: AxisKind) -> None:
        self._formula = Formula.of(keys, kind)
        self._keys = keys
        dimensions = {unit_of(each, kind).ascii: each for each in reversed(Dimension)}
        self.identifier = keys.name
        self.title = same(keys.title or keys.name)
        self.equation = keys.formula
        self.remedy = same(keys.remedy) if keys.remedy else None
        self.look = _LOOK.given(formula=keys.formula)
        self.linear = tuple(self._parameter(name, dimensions) for name in self._formula.linear)
        self.searched = tuple(self._parameter(name, dimensions) for name in self._formula.searched)
        self.shape = self._shape()

    def _parameter(self, name: str, dimensions: dict[str, Dimension]) -> Parameter:
        own, per_si = self._keys.parameters[name], self._formula.units[name].per_si
        low, high = (None, None) if own.range is None else (each / per_si for each in own.range)
        meaning = _MEANING.given(formula=self._keys.formula)
        return Parameter(name, name, dimensions[own.spelled], meaning, low, high)

    def _shape(self) -> Shape:
        names = self._formula.names
        if {"t", "v"} & {*names} or self._formula.columns:
            return Shape.TIME
        if "run" in names:
            return Shape.RUN
        return Shape.DIRECTION if "D" in names else Shape.POSITION

    def untestable(self, design: Design) -> Words | None:
        """Demand the logged columns of the formula; the feed is one, where a formula has it."""
        feed = ("v",) if "v" in self._formula.names else ()
        return needs_logged(design, *self._formula.columns, *feed)

    def grid(self, design: Design) -> FloatArray:
        """Return values between the ends of the ranges; lengths and times as close as waves of them ask."""
        each = [self._values(parameter, design) for parameter in self.searched]
        share = int(_MOST ** (1.0 / len(each))) if each else 0
        thinner = [one[np.linspace(0, len(one) - 1, min(len(one), share)).astype(int)] for one in each]
        rows = list(product(*thinner))
        return np.array(rows, dtype=np.float64).reshape(len(rows), len(each))

    def _values(self, parameter: Parameter, design: Design) -> FloatArray:
        own = self._keys.parameters[parameter.name]
        if own.value is not None:
            return np.array([own.value / self._formula.units[parameter.name].per_si])
        low, high = parameter.smallest or 0.0, parameter.largest or 0.0
        if low <= 0:
            return np.linspace(low, high, 2 * _FEWEST)
        extent = design.duration if parameter.dimension is Dimension.TIME else design.length
        wanted = _FEWEST + _PER_PERIOD * extent * (1.0 / low - 1.0 / high)
        return 1.0 / np.linspace(1.0 / high, 1.0 / low, int(min(wanted, _MOST)))

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return what each linear parameter is multiplied with."""
        readings = {"P": design.position, "D": design.direction, "t": design.time}
        readings["run"] = design.run.astype(np.float64)
        for name in self._formula.columns:
            kind = CONDITIONS.get(name)
            log = design.conditions[name]
            readings[name] = log if kind is None else kind.unit.from_si(log)
        if "v" in self._formula.names:
            readings["v"] = design.conditions["v"] / self._formula.units["v"].per_si
        named = [parameter.name for parameter in self.searched]
        return self._formula.values(readings, dict(zip(named, theta.tolist(), strict=True)))
