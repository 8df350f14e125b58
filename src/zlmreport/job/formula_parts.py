"""Checks a formula's units and names, and parts it into linear and searched parameters."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType
from typing import Any, TypeGuard

import numpy as np

from zlmreport.errors import find_nearest
from zlmreport.job import formula as parsing
from zlmreport.job.formula import (
    NUMBER,
    TEMPERATURE,
    TIME,
    TRAVEL,
    Extent,
    FormulaError,
    FormulaName,
    Number,
    Tree,
    UnitOf,
    compute,
    convert_formula_to_si,
    find_column_of,
    find_names_in,
    name_rates,
    parse_formula,
    simplify,
    split_terms_of,
    substitute,
    write_out_waves,
)
from zlmreport.job.formula_keys import FormulaKeys, FormulaParameter, Possible
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.measurement.units import ARCSECOND, DEGREE, MICROMETRE, MILLIMETRE

#: The names of the readings: target position, direction, time, run, feed.
VARIABLES = ("P", "D", "t", "run", "v")
#: Keys of the axis that a formula may name.
AXIS_KEYS = ("screw_pitch", "signal_period", "scale_element", "pole_pitch", "abbe_offset")
#: Values of tables of the axis at the position, by the key that names the table.
TABLES = {
    "compensation": "compensation_table",
    "compensation_next": "compensation_table",
    "compensation_before": "compensation_table",
    "angular_error": "angular_errors",
}
#: What follows from the test and the axis; a parameter of the same name goes before.
DERIVED = (
    *("since_reversal", "middle", "half_travel", "travel_first", "travel_last", "turn", "air_index"),
    *AXIS_KEYS,
    *TABLES,
)
#: What a bound of what is possible may depend on: the largest logged rise of a temperature of the axis, K.
RISE = "temperature_rise"
#: The key of an effect under which its parameters stand.
_PARAMETERS = "parameters"
_NAME = re.compile(r"[^\W\d]\w*", re.ASCII)
_PER_KELVIN = Extent(temperature=Fraction(-1))
_TRAVEL_PER_KELVIN = Extent(travel=Fraction(1), temperature=Fraction(-1))
_ANY_AXIS = {"s": UnitOf(TIME), "1": UnitOf(NUMBER)}
#: Units in which parameters are given, by the kind of axis: those in which results print them.
UNITS: Mapping[AxisKind, Mapping[str, UnitOf]] = MappingProxyType(
    {
        AxisKind.LINEAR: {
            "um": UnitOf(TRAVEL, MICROMETRE.per_si),
            "mm": UnitOf(TRAVEL, MILLIMETRE.per_si),
            "um/m": UnitOf(NUMBER, 1e6),
            "um/K": UnitOf(_TRAVEL_PER_KELVIN, 1e6),
            "um/(m K)": UnitOf(_PER_KELVIN, 1e6),
            "deg": UnitOf(NUMBER, DEGREE.per_si),
            **_ANY_AXIS,
        },
        AxisKind.ROTARY: {
            "arcsec": UnitOf(TRAVEL, ARCSECOND.per_si),
            "deg": UnitOf(TRAVEL, DEGREE.per_si),
            "arcsec/deg": UnitOf(NUMBER, ARCSECOND.per_si / DEGREE.per_si),
            "arcsec/K": UnitOf(_TRAVEL_PER_KELVIN, ARCSECOND.per_si),
            "arcsec/(deg K)": UnitOf(_PER_KELVIN, ARCSECOND.per_si / DEGREE.per_si),
            **_ANY_AXIS,
        },
    }
)
#: Values of a parameter of which only some make sense: each is tried.
_MOST_SENSIBLE = 10_000
_SAMPLES, _STEP, _DEPENDENT, _SEED = 60, 1e-4, 1e-7, 20_261_122
_NEAR = tuple(np.linspace(-1.2, 1.2, 25).tolist())
#: Between which positions formulas are tried, m or rad. A step at 1.8 m or at -0.5 m shows on no first metre.
_POSITIONS = ((0.05, 1.0), (-1.0, 1.0), (-10.0, 10.0), (-100.0, 100.0))
#: What the axis and the test are like where formulas are tried, SI.
_TRIED = {
    "middle": 0.525,
    "half_travel": 0.475,
    "travel_first": 0.05,
    "travel_last": 1.0,
    "turn": 2 * np.pi,
    "screw_pitch": 0.01,
    "signal_period": 20e-6,
    "scale_element": 0.5,
    "pole_pitch": 0.024,
    "abbe_offset": 0.2,
}


class Formula:
    """A formula on one kind of axis: in SI, and parted into what is solved and what is searched."""

    def __init__(
        self, keys: FormulaKeys, tree: Tree, units: Mapping[str, UnitOf], parts: Mapping[str, tuple[str, ...]]
    ) -> None:
        self.keys = keys  #: As a file says it.
        self.tree = tree  #: The formula, waves written out.
        self.units = units  #: Of all names.
        self.names = find_names_in(tree)
        #: Of each size of a wave, the parameters that took its place.
        self.parts = parts
        names = [each for name in keys.parameters for each in parts.get(name, (name,)) if each in self.names]
        columns = [name for name in self.names if name not in {*names, *VARIABLES, *DERIVED}]
        #: Logged columns that stand in it, or whose rates do.
        self.columns = tuple(dict.fromkeys(find_column_of(name) or name for name in columns))
        terms = split_terms_of(tree)
        #: The parameters that are factors of whole terms, in the order of the file.
        self.linear = _find_linear(terms, names)
        self.searched = tuple(name for name in names if name not in self.linear)  #: The others.
        #: Values of parameters that the file gives.
        self.given = {
            name: each.value / units[name].per_si
            for name, each in keys.parameters.items()
            if each.value is not None and name in self.names
        }
        #: What each linear parameter is multiplied with.
        self.multiplied = {name: _find_factor_of(name, tree, self.linear) for name in self.linear}

    @classmethod
    def of(
        cls,
        keys: FormulaKeys,
        kind: AxisKind,
        orders: Sequence[int] | None = None,
        choices: Mapping[str, str] = MappingProxyType({}),
    ) -> Formula:
        """Return the formula of a file on one kind of axis.

        `orders`: The harmonics of its wave; without them the usual ones.
        `choices`: The values of its keys; of one that is not among them the first.

        Raises `FormulaError` with what is wrong with it.
        """
        if orders is None:
            orders = keys.harmonics.usual if keys.harmonics else (1,)
        tree = name_rates(parse_formula(keys.formula))
        used = [*find_names_in(tree)]
        for key in keys.keys:
            meanings = {
                value: {name: name_rates(parse_formula(text)) for name, text in chosen.items()}
                for value, chosen in key.choices.items()
            }
            used += [
                name for each in meanings.values() for form in each.values() for name in find_names_in(form)
            ]
            tree = substitute(tree, meanings[choices.get(key.name, next(iter(meanings)))])
        _refuse_names(keys, used)
        tree, parts = write_out_waves(tree, orders, keys.parameters)
        units = _derive_units(keys, find_names_in(tree), kind, parts)
        tree, extent = convert_formula_to_si(tree, units)
        if extent != TRAVEL:
            raise FormulaError(f"its value must be a deviation, as a parameter in um is; it is {extent}")
        found = cls(keys, tree, units, parts)
        for name in found.searched:
            if not _is_searchable(keys.parameters[name]):
                message = f"{name} is no factor of a whole term and must be searched; state its range"
                raise FormulaError(message, _PARAMETERS, name)
            _refuse_countless(name, keys.parameters[name])
        for name in parts:
            if keys.parameters[name].value is not None or keys.parameters[name].equals is not None:
                message = f"{name} is the size of a wave, which has two parts; give neither value nor equals"
                raise FormulaError(message, _PARAMETERS, name)
        return found

    def compute_values(
        self, readings: Mapping[str, FloatArray | float], searched: Mapping[str, float]
    ) -> FloatArray:
        """Return what each linear parameter is multiplied with, SI, shape (N, len(linear)).

        `readings`: Of each variable and each column that stands in it, SI but temperatures in °C, shape (N,).
        """
        known: dict[str, FloatArray | float] = {**readings, **searched}
        count = max((np.size(each) for each in readings.values()), default=1)
        found = np.empty((count, len(self.linear)))
        for place, tree in enumerate(self.multiplied.values()):
            found[:, place] = compute(tree, known)
        return found

    def list_sensible(self, name: str) -> FloatArray | None:
        """Return the only values, SI, of a searched parameter that make sense; None where any does."""
        own = self.keys.parameters[name]
        values = np.array(own.values)
        low, high = own.range or (None, None)
        if own.step is not None and low is not None and high is not None:
            values = np.arange(low, high + own.step / 2, own.step)
        return values / self.units[name].per_si if len(values) else None

    def find_stated(self, name: str, of_axis: Mapping[str, float | None]) -> float | None:
        """Return the value, SI, of a parameter that follows from keys of the axis; None where it does not.

        `of_axis`: The keys, SI.
        """
        text = self.keys.parameters[name].stated if name in self.keys.parameters else None
        if text is None:
            return None
        tree = parse_formula(text)
        values = {each: of_axis[each] for each in find_names_in(tree)}
        if None in values.values():
            return None
        return float(compute(tree, values))  # type: ignore[arg-type]  # none of them is None

    def compute_bounds(self, name: str, rise: float | None) -> tuple[float, float]:
        """Return between which values, SI, physics allows a parameter; infinite where it does not care.

        `rise`: The largest logged rise of a temperature, K; None where none was logged: what depends on it
            is then no bound.
        """
        own = self.keys.parameters[name].possible if name in self.keys.parameters else None
        low, high = (own.least, own.most) if own else (None, None)
        bounds = (_compute_bound(low, rise), _compute_bound(high, rise))
        least, most = (None if each is None else each / self.units[name].per_si for each in bounds)
        return -np.inf if least is None else least, np.inf if most is None else most

    def refuse_undetermined(self) -> None:
        """Refuse parameters that no readings at all could tell apart: two that stand for one.

        Raises `FormulaError`.
        """
        free = [name for name in self.searched if name not in self.given]
        names = [*self.linear, *free]
        self._refuse_zeros(free)
        tried = [self._compute_slopes(free, *positions) for positions in _POSITIONS]
        finite = [each for each in tried if np.all(np.isfinite(each))]
        if not finite:
            raise FormulaError("it has no finite value at usual readings, or none within the ranges")
        together = next((each for each in finite if each.any(axis=0).all()), finite[0])
        lengths = np.linalg.norm(together, axis=0)
        if not lengths.all():
            raise FormulaError(f"{names[int(np.argmin(lengths))]} changes nothing in it")
        if np.linalg.svd(together / lengths, compute_uv=False)[-1] < _DEPENDENT:
            raise FormulaError(f"no readings could tell {', '.join(names)} apart; one of them is too many")

    def _refuse_zeros(self, free: list[str]) -> None:
        """Refuse a range that begins or ends at 0 where the formula divides by the parameter.

        Where it is told what is searched, the values that are tried follow from the test: none of them is 0.
        """
        for name in free:
            parameter = self.keys.parameters[name]
            is_told = parameter.search or parameter.stated or parameter.values
            if not is_told and parameter.range and 0.0 in parameter.range:
                theta = {each: self._find_middle(each) for each in self.searched} | {name: 0.0}
                tried = (
                    self.compute_values(self._make_readings(theta, *positions), theta)
                    for positions in _POSITIONS
                )
                if not any(np.isfinite(each).all() for each in tried):
                    message = (
                        f"it has no value where {name} is 0, an end of its range; let the range leave 0 out"
                    )
                    raise FormulaError(message, _PARAMETERS, name, "range")

    def _make_readings(self, theta: Mapping[str, float], first: float, last: float) -> dict[str, Any]:
        """Return readings between two positions, m or rad, at which a formula is tried."""
        random = np.random.default_rng(_SEED)
        places = np.append(random.uniform(first, last, _SAMPLES), self._place_around(theta, TRAVEL))
        moments = np.append(random.uniform(1.0, 3600.0, _SAMPLES), self._place_around(theta, TIME))
        count = max(len(places), len(moments))
        return {
            **_TRIED,
            "P": np.resize(places, count),
            "D": random.choice([-1.0, 1.0], count),
            # Not in the order of the places: what shows at a place and what at a moment would be one.
            "t": random.permutation(np.resize(moments, count)),
            "run": random.integers(1, 9, count).astype(np.float64),
            "v": random.uniform(0.01, 0.1, count),
            **{name: random.uniform(15.0, 25.0, count) for name in self.columns},
            **{f"rate({name})": random.uniform(-1e-3, 1e-3, count) for name in self.columns},
            "since_reversal": random.uniform(0.0, 0.5, count),
            "air_index": random.uniform(-1e-6, 1e-6, count),
            **{name: random.uniform(-1e-5, 1e-5, count) for name in TABLES},
        }

    def _compute_slopes(self, free: list[str], first: float, last: float) -> FloatArray:
        """Return what each parameter changes at readings between two positions, m or rad, shape (N, k)."""
        theta = {name: self._find_middle(name) for name in self.searched}
        readings = self._make_readings(theta, first, last)
        columns = self.compute_values(readings, theta)
        slopes = [columns]
        for name in free:
            low, high = self._find_ends(name)
            # Where a step is moved by little, no reading passes it.
            for step in (_STEP * (abs(theta[name]) or 1.0), (high - low) / 4):
                moved = self.compute_values(readings, {**theta, name: theta[name] + step})
                with np.errstate(invalid="ignore"):  # far away, an exponential is infinite
                    slope = ((moved - columns) / step).sum(axis=1, keepdims=True)
                if slope.any():
                    break
            slopes.append(slope)
        return np.concatenate(slopes, axis=1)

    def _place_around(self, theta: Mapping[str, float], extent: Extent) -> FloatArray:
        """Return positions, or times, close to those that stand in it: a narrow form shows nowhere else.

        And within the range of each: an edge that lies between two targets moves no further.
        """
        own = {name: value for name, value in theta.items() if self.units[name].extent == extent}
        ends = {name: self._find_ends(name) for name in own}
        widths = {name: {*own.values(), (high - low) / 2} for name, (low, high) in ends.items()}
        return np.array(
            [own[name] + share * width for name in own for width in sorted(widths[name]) for share in _NEAR]
        )

    def _find_ends(self, name: str) -> tuple[float, float]:
        """Return the ends of a range, SI; of one that is open, what is likely there."""
        own, per_si = self.keys.parameters[name], self.units[name].per_si
        low, high = own.range or ((min(own.values), max(own.values)) if own.values else (None, None))
        likely = {TRAVEL: (0.05, 0.6), TIME: (60.0, 1800.0)}.get(self.units[name].extent, (1.0, 9.0))
        return (
            likely[0] if low is None else low / per_si,
            max(likely[1], 2 * low / per_si if low else 0.0) if high is None else high / per_si,
        )

    def _find_middle(self, name: str) -> float:
        if name in self.given:
            return self.given[name]
        low, high = self._find_ends(name)
        return 0.5 * low + 0.5 * high or 0.25 * low + 0.75 * high


def refuse_unsound(keys: FormulaKeys) -> None:
    """Refuse a formula that cannot be meant for an axis of any kind.

    Raises `FormulaError` with what is wrong with it on the kind that its units fit.
    """
    failed: FormulaError | None = None
    for kind in find_kinds_of(keys) or [AxisKind.LINEAR]:
        try:
            Formula.of(keys, kind).refuse_undetermined()
        except FormulaError as error:
            failed = failed or error
        else:
            return
    assert failed is not None  # noqa: S101  # one kind at least was tried
    raise FormulaError(f"{failed}{_say_nearest(keys)}", *failed.key) from failed


def find_nearest_known(name: str, keys: FormulaKeys, logged: Iterable[str] = ()) -> str | None:
    """Return what a name of a formula may have been meant for: a parameter, a variable, a logged column."""
    return find_nearest(name, (*logged, *CONDITIONS, *DERIVED, *VARIABLES, *keys.parameters))


def _say_nearest(keys: FormulaKeys) -> str:
    """Return the end of a message on a formula with a name that is none of its own; mostly empty."""
    try:
        names = find_names_in(name_rates(parse_formula(keys.formula)))
    except FormulaError:
        return ""
    known = {*keys.parameters, *VARIABLES, *DERIVED, *CONDITIONS}
    known |= {each for key in keys.keys for chosen in key.choices.values() for each in chosen}
    for name in (find_column_of(each) or each for each in names):
        if name not in known:
            nearest = find_nearest_known(name, keys)
            return f"; {name} is read as a logged column" + (f": did you mean {nearest}?" if nearest else "")
    return ""


def find_kinds_of(keys: FormulaKeys) -> list[AxisKind]:
    """Return the kinds of axes whose units the parameters of a formula have."""
    units = [each.spelled for each in keys.parameters.values()]
    return [kind for kind in AxisKind if all(each in UNITS[kind] for each in units)]


def _is_searchable(parameter: FormulaParameter) -> bool:
    """Return whether it is known where to search for a parameter."""
    has_ends = parameter.range is not None and None not in parameter.range
    return (
        has_ends
        or parameter.value is not None
        or bool(parameter.search or parameter.stated or parameter.values)
    )


def _refuse_countless(name: str, parameter: FormulaParameter) -> None:
    """Refuse a step that is too fine for its range: every value between its ends is tried."""
    low, high = parameter.range or (None, None)
    if parameter.step is not None and low is not None and high is not None:
        count = (high - low) / parameter.step
        if count > _MOST_SENSIBLE:
            raise FormulaError(
                f"steps of {parameter.step:g} are {count:.3g} values from {low:g} to {high:g}, and "
                f"{_MOST_SENSIBLE:,} are the most; take a larger step, or none",
                _PARAMETERS,
                name,
                "step",
            )


def _refuse_names(keys: FormulaKeys, used: Sequence[str]) -> None:
    for name in keys.parameters:
        if not _NAME.fullmatch(name) or name in {*VARIABLES, *parsing.CONSTANTS}:
            raise FormulaError(f"a parameter cannot be called {name!r}", _PARAMETERS, name)
        if name not in used:
            raise FormulaError(f"the parameter {name} does not stand in it")


def _derive_units(
    keys: FormulaKeys, names: tuple[str, ...], kind: AxisKind, parts: Mapping[str, Sequence[str]]
) -> dict[str, UnitOf]:
    per_si = MILLIMETRE.per_si if kind is AxisKind.LINEAR else DEGREE.per_si
    found = {name: UnitOf(TRAVEL, per_si) for name in ("P", *DERIVED)}
    found |= {
        "D": UnitOf(NUMBER),
        "t": UnitOf(TIME),
        "run": UnitOf(NUMBER),
        "v": UnitOf(TRAVEL.combine(TIME, -1), 60.0 * per_si),
        "air_index": UnitOf(NUMBER),
        "angular_error": UnitOf(NUMBER),
    }
    for name, each in keys.parameters.items():
        if each.spelled not in UNITS[kind]:
            message = f"{each.unit!r} does not belong to a {kind.value} axis"
            raise FormulaError(message, _PARAMETERS, name, "unit")
        found.update(dict.fromkeys((name, *parts.get(name, ())), UNITS[kind][each.spelled]))
        if each.stated is not None:
            _refuse_stated(name, each.stated, found)
        if each.possible is not None:
            _refuse_possible(name, each.possible)
    for name in names:
        column = find_column_of(name)
        own = TEMPERATURE if (column or name).endswith("temperature") else NUMBER
        found.setdefault(name, UnitOf(own.combine(TIME, -1) if column else own))
    return found


def _compute_bound(stated: float | str | None, rise: float | None) -> float | None:
    """Return a bound in the unit of its parameter; None where there is none."""
    if not isinstance(stated, str):
        return stated
    return None if rise is None else float(compute(parse_formula(stated), {RISE: rise}))


def _refuse_possible(name: str, possible: Possible) -> None:
    """Refuse a bound that depends on anything but the logged rise of the temperature."""
    for end, text in (("least", possible.least), ("most", possible.most)):
        key = (_PARAMETERS, name, "possible", end)
        names = find_names_in(_parse_at(text, *key)) if isinstance(text, str) else ()
        for unknown in (each for each in names if each != RISE):
            raise FormulaError(f"a bound depends on {RISE} alone, not on {unknown}", *key)


def _refuse_stated(name: str, text: str, units: Mapping[str, UnitOf]) -> None:
    """Refuse what is to state a parameter if it is made of other things than keys, or is another quantity."""
    key = (_PARAMETERS, name, "stated")
    tree = _parse_at(text, *key)
    unknown = [each for each in find_names_in(tree) if each not in {*AXIS_KEYS, "turn"}]
    if unknown:
        raise FormulaError(f"{unknown[0]} is no key of the axis; there are {', '.join(AXIS_KEYS)}", *key)
    try:
        _, extent = convert_formula_to_si(tree, units)
    except FormulaError as error:
        raise FormulaError(str(error), *key) from error
    if extent != units[name].extent:
        raise FormulaError(f"{name} is {units[name].extent}, and {text} is {extent}", *key)


def _parse_at(text: str, *key: str) -> Tree:
    """Return a formula that stands at another key of its effect."""
    try:
        return parse_formula(text)
    except FormulaError as error:
        raise FormulaError(str(error), *key) from error


def _find_linear(terms: tuple[tuple[Tree, ...], ...], parameters: list[str]) -> tuple[str, ...]:
    """Return the parameters that are factors of whole terms, one for each term."""
    found: list[str] = []
    for name in parameters:
        holding = [term for term in terms if any(name in find_names_in(factor) for factor in term)]
        alone = all(
            sum(name in find_names_in(factor) for factor in term) == 1 and FormulaName(name) in term
            for term in holding
        )
        if alone and not any(_is_one_of(factor, found) for term in holding for factor in term):
            found.append(name)
    for term in terms:
        if not any(_is_one_of(factor, found) for factor in term):
            raise FormulaError("each term must have a size to be estimated, as a in a*sin(P/L)")
    return tuple(name for name in parameters if name in found)


def _find_factor_of(name: str, tree: Tree, linear: Sequence[str]) -> Tree:
    """Return what a parameter is multiplied with: the formula with it as one, and the other sizes zero."""
    return simplify(substitute(tree, {each: Number(float(each == name)) for each in linear}))


def _is_one_of(factor: Tree, names: tuple[str, ...] | list[str]) -> TypeGuard[FormulaName]:
    return isinstance(factor, FormulaName) and factor.text in names
