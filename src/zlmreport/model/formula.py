"""Effects that a job writes as a formula, without Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from types import MappingProxyType

import numpy as np

from zlmreport.job.formula_keys import Formula, FormulaKeys
from zlmreport.language import Words, same
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.model.design import Design
from zlmreport.model.effect import Dimension, Effect, Parameter, Shape, needs_logged, unit_of
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.formula import Call, Tree, calls_in, computed

#: Values of searched parameters that are tried: at most all together, of one alone, in each of its periods.
_MOST, _FEWEST, _PER_PERIOD = 400, 12, 4
#: Steps that find a joint between two positions, each to half the distance.
_HALVINGS = 40
#: Functions that repeat with their argument, that fade with it, and that jump or bend where it is zero.
_WAVES = frozenset({"sin", "cos", "tan"})
_FADING = frozenset({"exp", "tanh", "atan"})
_JOINTS = frozenset({"step", "sign", "abs", "min", "max"})
_STATED = Words(
    en="stated where the formula is written; no standard states them",
    de="dort angegeben, wo die Formel steht; keine Norm nennt sie",
)
_LOOK = Words(en="The residuals follow {formula}.", de="Die Residuen folgen {formula}.")
_MEANING = Words(en="parameter of {formula}", de="Parameter von {formula}")


def search_grid(
    design: Design, searched: Sequence[Parameter], known: Mapping[str, float] = MappingProxyType({})
) -> FloatArray:
    """Return values of parameters that a search begins with, shape (g, len(searched)).

    They lie between the ends of the plausible ranges, which must be stated; lengths and times as close as
    waves of them ask for.

    Parameters
    ----------
    design
        The test.
    searched
        The parameters.
    known
        Values, SI, of those that are not searched, by name.
    """
    each = [
        np.array([known[parameter.name]]) if parameter.name in known else _starts(parameter, design)
        for parameter in searched
    ]
    share = int(_MOST ** (1.0 / len(each))) if each else 0
    thinner = [one[np.linspace(0, len(one) - 1, min(len(one), share)).astype(int)] for one in each]
    rows = list(product(*thinner))
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(each))


def _starts(parameter: Parameter, design: Design) -> FloatArray:
    low, high = parameter.smallest or 0.0, parameter.largest or 0.0
    if low <= 0:
        return np.linspace(low, high, 2 * _FEWEST)
    extent = design.duration if parameter.dimension is Dimension.TIME else design.length
    wanted = _FEWEST + _PER_PERIOD * extent * (1.0 / low - 1.0 / high)
    return 1.0 / np.linspace(1.0 / high, 1.0 / low, int(min(wanted, _MOST)))


class FormulaEffect(Effect):
    """An effect that is written as a formula in a file.

    Raises `FormulaError` if it cannot be meant for an axis of this kind.
    """

    ranges_from = _STATED

    def __init__(self, keys: FormulaKeys, kind: AxisKind) -> None:
        self.formula = Formula.of(keys, kind)  #: In SI, and parted into what is solved and what is searched.
        self.keys = keys  #: As the file says it.
        dimensions = {unit_of(each, kind).ascii: each for each in reversed(Dimension)}
        self.identifier = keys.name
        self.title = same(keys.title or keys.name)
        self.equation = keys.formula
        self.remedy = same(keys.remedy) if keys.remedy else None
        self.look = _LOOK.given(formula=keys.formula)
        self.linear = tuple(self._parameter(name, dimensions) for name in self.formula.linear)
        self.searched = tuple(self._parameter(name, dimensions) for name in self.formula.searched)
        self.shape = self._shape()

    def _parameter(self, name: str, dimensions: dict[str, Dimension]) -> Parameter:
        own, per_si = self.keys.parameters[name], self.formula.units[name].per_si
        low, high = (None, None) if own.range is None else (each / per_si for each in own.range)
        meaning = _MEANING.given(formula=self.keys.formula)
        return Parameter(name, name, dimensions[own.spelled], meaning, low, high)

    def _shape(self) -> Shape:
        names = self.formula.names
        if {"t", "v"} & {*names} or self.formula.columns:
            return Shape.TIME
        if "run" in names:
            return Shape.RUN
        return Shape.DIRECTION if "D" in names else Shape.POSITION

    def untestable(self, design: Design) -> Words | None:
        """Demand the logged columns of the formula; the feed is one, where a formula has it."""
        feed = ("v",) if "v" in self.formula.names else ()
        return needs_logged(design, *self.formula.columns, *feed)

    def grid(self, design: Design) -> FloatArray:
        """Return values between the ends of the ranges; those that are stated are known."""
        return search_grid(design, self.searched, self.formula.stated)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return what each linear parameter is multiplied with."""
        return self.formula.values(self._readings(design), self._named(theta))

    def shortest_wave(self, along: Design, theta: FloatArray) -> float:
        """Return the length of the shortest wave at rising positions, m or rad; infinite without any."""
        calls = calls_in(self.formula.tree, _WAVES)
        phases = [self._over_position(call.arguments[0], along, theta)(along.position) for call in calls]
        return 2 * np.pi * _shortest(along, phases)

    def shortest_fading(self, along: Design, theta: FloatArray) -> float:
        """Return the shortest length over which a part of it comes or goes, m or rad; infinite without."""
        calls = calls_in(self.formula.tree, _FADING)
        values = [self._over_position(call, along, theta)(along.position) for call in calls]
        return _shortest(along, [value / np.abs(value).max() for value in values if value.any()])

    def joints(self, along: Design, theta: FloatArray) -> list[float]:
        """Return where it jumps or bends between rising positions, m or rad."""
        found: list[float] = []
        for call in calls_in(self.formula.tree, _JOINTS):
            zero = Call("-", call.arguments) if len(call.arguments) > 1 else call.arguments[0]
            value = self._over_position(zero, along, theta)
            signs = np.nan_to_num(np.sign(value(along.position)))
            before = np.flatnonzero(np.diff(signs))
            low, high = along.position[before], along.position[before + 1]
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                is_low = np.sign(value(middle)) == signs[before]
                low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
            found += low.tolist()
        return found

    def _over_position(
        self, part: Tree, along: Design, theta: FloatArray
    ) -> Callable[[FloatArray], FloatArray]:
        """Return a part of the formula as a function of the position, all else being as in a design."""
        known = {name: values[0] for name, values in self._readings(along).items()} | self._named(theta)
        return lambda places: np.broadcast_to(computed(part, {**known, "P": places}), places.shape)

    def _named(self, theta: FloatArray) -> dict[str, float]:
        names = [parameter.name for parameter in self.searched]
        return dict(zip(names, theta.tolist(), strict=True))

    def _readings(self, design: Design) -> dict[str, FloatArray]:
        readings = {"P": design.position, "D": design.direction, "t": design.time}
        readings["run"] = design.run.astype(np.float64)
        for name in self.formula.columns:
            kind = CONDITIONS.get(name)
            log = design.conditions[name]
            readings[name] = log if kind is None else kind.unit.from_si(log)
        if "v" in self.formula.names:
            readings["v"] = design.conditions["v"] / self.formula.units["v"].per_si
        return readings


def _shortest(along: Design, values: list[FloatArray]) -> float:
    """Return the shortest length in which one of some values changes by 1; infinite if none does."""
    with np.errstate(all="ignore"):
        slopes = np.abs(np.diff(np.array(values)) / np.diff(along.position)) if values else np.zeros(1)
        return float(1.0 / slopes[np.isfinite(slopes)].max(initial=0.0))
