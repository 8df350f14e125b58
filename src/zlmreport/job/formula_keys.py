"""An effect that a file writes as a formula: its keys, held against the units of what stands in it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from types import MappingProxyType
from typing import Annotated, TypeAlias, TypeGuard

import numpy as np
from pydantic import Field, ValidationInfo, field_validator

from zlmreport.job.types import Finite, JobPart, Options, Text
from zlmreport.measurement.axis import AxisKind
from zlmreport.quantities import formula as parsing
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.formula import (
    NUMBER,
    TEMPERATURE,
    TIME,
    TRAVEL,
    Call,
    FormulaError,
    Name,
    Number,
    Tree,
    UnitOf,
    computed,
    in_si,
    names_in,
    parse_formula,
    terms_of,
)
from zlmreport.quantities.units import ARCSECOND, DEGREE, MICROMETRE, MILLIMETRE

#: The names of the readings: target position, direction, time, run, feed.
VARIABLES = ("P", "D", "t", "run", "v")
_NAME = re.compile(r"[^\W\d]\w*", re.ASCII)
_PER_KELVIN = TEMPERATURE.raised(Fraction(-1))
_ANY_AXIS = {"s": UnitOf(TIME), "1": UnitOf(NUMBER)}
#: Units in which parameters are given, by the kind of axis: those in which results print them.
UNITS: Mapping[AxisKind, Mapping[str, UnitOf]] = MappingProxyType(
    {
        AxisKind.LINEAR: {
            "um": UnitOf(TRAVEL, MICROMETRE.per_si),
            "mm": UnitOf(TRAVEL, MILLIMETRE.per_si),
            "um/m": UnitOf(NUMBER, 1e6),
            "um/K": UnitOf(TRAVEL.combined(_PER_KELVIN), 1e6),
            "um/(m K)": UnitOf(_PER_KELVIN, 1e6),
            "deg": UnitOf(NUMBER, DEGREE.per_si),
            **_ANY_AXIS,
        },
        AxisKind.ROTARY: {
            "arcsec": UnitOf(TRAVEL, ARCSECOND.per_si),
            "deg": UnitOf(TRAVEL, DEGREE.per_si),
            "arcsec/deg": UnitOf(NUMBER, ARCSECOND.per_si / DEGREE.per_si),
            "arcsec/K": UnitOf(TRAVEL.combined(_PER_KELVIN), ARCSECOND.per_si),
            "arcsec/(deg K)": UnitOf(_PER_KELVIN, ARCSECOND.per_si / DEGREE.per_si),
            **_ANY_AXIS,
        },
    }
)
_SPELLINGS = (("µ", "u"), ("μ", "u"), ("″", "arcsec"), ("°", "deg"), ("*", " "), ("·", " "))
_SAMPLES, _STEP, _DEPENDENT, _SEED = 60, 1e-4, 1e-7, 20_261_122
#: Between which positions formulas are tried, m or rad. A step at 1.8 m or at -0.5 m shows on no first metre.
_POSITIONS = ((0.05, 1.0), (-1.0, 1.0), (-10.0, 10.0), (-100.0, 100.0))


#: A parameter of an effect of the model.
ParameterName: TypeAlias = Annotated[str, Field(pattern=r"^[a-z][a-z0-9-]*\.\w+$")]


class FormulaParameter(JobPart):
    """A parameter of a formula."""

    unit: Text = Field(
        "1",
        description="Of its value: um, mm, um/m, um/K, um/(m K), s, deg or 1; on a rotary axis arcsec, deg, "
        "arcsec/deg, arcsec/K, arcsec/(deg K), s or 1.",
        examples=["um"],
    )
    range: tuple[Finite, Finite] | None = Field(
        None,
        description="Smallest and largest plausible value; a parameter that is no factor of a whole term "
        "must have them, and is searched between them.",
    )
    value: Finite | None = Field(None, description="The value, where it is known and not estimated.")
    equals: ParameterName | None = Field(
        None,
        description="The parameter of another effect that it is: both are estimated as one.",
        examples=["screw-pitch.period"],
    )

    @property
    def spelled(self) -> str:
        """The unit as `UNITS` has it."""
        return _spelled(self.unit)

    @field_validator("unit")
    @classmethod
    def _is_a_unit(cls, unit: str) -> str:
        if not any(_spelled(unit) in UNITS[kind] for kind in AxisKind):
            listed = ", ".join(UNITS[AxisKind.LINEAR])
            raise ValueError(f"{unit!r} is no unit of a parameter; there are {listed}")
        return unit

    @field_validator("range")
    @classmethod
    def _rises(cls, ends: tuple[float, float] | None) -> tuple[float, float] | None:
        if ends is not None and not ends[0] < ends[1]:
            raise ValueError("the first end of its range must be less than the second")
        return ends


def _spelled(unit: str) -> str:
    for found, written in _SPELLINGS:
        unit = unit.replace(found, written)
    return " ".join(unit.split())


class FormulaKeys(Options):
    """An effect that is written as a formula."""

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9]*(-[a-z0-9]+)*$", max_length=60)] = Field(
        description="What the job and the results call it: small letters, digits and hyphens.",
        examples=["my-wave"],
    )
    parameters: dict[str, FormulaParameter] = Field(
        description="Its parameters, each with its unit and its range.", min_length=1, max_length=20
    )
    formula: Text = Field(
        description="The deviation, of the parameters and P (target position), D (direction, +1 or −1), t "
        "(time from the first reading), run, v (feed) and logged columns by their names (temperatures in "
        "°C); with + − * / ^, pi, sin, cos, tan, atan, exp, log, tanh, sqrt, abs, min, max, sign and step. "
        "It is parsed, never executed.",
        examples=["a*sin(2*pi*P/L)"],
    )
    title: Text | None = Field(None, description="In words.")
    remedy: Text | None = Field(None, description="What to do about it, and what a compensation can do.")

    def __hash__(self) -> int:
        """Let a fit be kept by what its model means."""
        return hash((self.name, self.formula, self.title, self.remedy, *sorted(self.parameters)))

    @field_validator("formula")
    @classmethod
    def _is_sound(cls, formula: str, others: ValidationInfo) -> str:
        """Hold the formula against its parameters, which stand before it here and are sound themselves."""
        parameters: dict[str, FormulaParameter] | None = others.data.get("parameters")
        if parameters is None:
            return formula
        keys = cls.model_construct(name=others.data.get("name", ""), formula=formula, parameters=parameters)
        units = [each.spelled for each in parameters.values()]
        kinds = [kind for kind in AxisKind if all(each in UNITS[kind] for each in units)]
        failed: FormulaError | None = None
        for kind in kinds or [AxisKind.LINEAR]:
            try:
                Formula.of(keys, kind)
            except FormulaError as error:
                failed = failed or error
            else:
                return formula
        raise ValueError(f"{keys.name}: {failed}")


class Formula:
    """A formula on one kind of axis: in SI, and parted into what is solved and what is searched."""

    def __init__(self, keys: FormulaKeys, tree: Tree, units: Mapping[str, UnitOf]) -> None:
        self.tree = tree  #: The formula.
        self.units = units  #: Of all names.
        self.names = names_in(tree)
        known = {*keys.parameters, *VARIABLES}
        #: Logged columns that stand in it.
        self.columns = tuple(name for name in self.names if name not in known)
        terms = terms_of(tree)
        #: The parameters that are factors of whole terms, in the order of the file.
        self.linear = _linear(terms, list(keys.parameters))
        self.searched = tuple(name for name in keys.parameters if name not in self.linear)  #: The others.
        #: Values of parameters that the file gives.
        self.stated = {
            name: each.value / units[name].per_si
            for name, each in keys.parameters.items()
            if each.value is not None
        }
        #: What each linear parameter is multiplied with.
        self.multiplied = {name: _multiplied_with(name, terms) for name in self.linear}

    @classmethod
    def of(cls, keys: FormulaKeys, kind: AxisKind) -> Formula:
        """Return the formula of a file on one kind of axis.

        Raises `FormulaError` with what is wrong with it.
        """
        tree = parse_formula(keys.formula)
        _refuse_names(keys, names_in(tree))
        units = _units(keys, names_in(tree), kind)
        tree, extent = in_si(tree, units)
        if extent != TRAVEL:
            raise FormulaError(f"its value must be a deviation, as a parameter in um is; it is {extent}")
        found = cls(keys, tree, units)
        for name in found.searched:
            if keys.parameters[name].range is None and keys.parameters[name].value is None:
                raise FormulaError(
                    f"{name} is no factor of a whole term and must be searched; state its range"
                )
        found._refuse_undetermined(keys)
        return found

    def values(self, readings: Mapping[str, FloatArray], searched: Mapping[str, float]) -> FloatArray:
        """Return what each linear parameter is multiplied with, SI, shape (N, len(linear)).

        `readings`: Of each variable and each column that stands in it, SI but temperatures in °C, shape (N,).
        """
        known: dict[str, FloatArray | float] = {**readings, **searched}
        count = max((np.size(each) for each in readings.values()), default=1)
        columns = (computed(tree, known) for tree in self.multiplied.values())
        return np.stack([np.broadcast_to(each, (count,)) for each in columns], axis=1)

    def _refuse_undetermined(self, keys: FormulaKeys) -> None:
        """Refuse parameters that no readings at all could tell apart: two that stand for one."""
        free = [name for name in self.searched if keys.parameters[name].value is None]
        names = [*self.linear, *free]
        tried = [self._slopes(keys, free, *positions) for positions in _POSITIONS]
        finite = [each for each in tried if np.all(np.isfinite(each))]
        if not finite:
            raise FormulaError("it has no finite value at usual readings, or none within the ranges")
        together = next((each for each in finite if each.any(axis=0).all()), finite[0])
        lengths = np.linalg.norm(together, axis=0)
        if not lengths.all():
            raise FormulaError(f"{names[int(np.argmin(lengths))]} changes nothing in it")
        if np.linalg.svd(together / lengths, compute_uv=False)[-1] < _DEPENDENT:
            raise FormulaError(f"no readings could tell {', '.join(names)} apart; one of them is too many")

    def _slopes(self, keys: FormulaKeys, free: list[str], first: float, last: float) -> FloatArray:
        """Return what each parameter changes at readings between two positions, m or rad, shape (N, k)."""
        random = np.random.default_rng(_SEED)
        readings = {
            "P": random.uniform(first, last, _SAMPLES),
            "D": random.choice([-1.0, 1.0], _SAMPLES),
            "t": random.uniform(1.0, 3600.0, _SAMPLES),
            "run": random.integers(1, 9, _SAMPLES).astype(np.float64),
            "v": random.uniform(0.01, 0.1, _SAMPLES),
            **{name: random.uniform(15.0, 25.0, _SAMPLES) for name in self.columns},
        }
        theta = {name: self._middle(keys.parameters[name], name) for name in self.searched}
        columns = self.values(readings, theta)
        slopes = [columns]
        for name in free:
            low, high = keys.parameters[name].range or (0.0, 0.0)
            # Where a step is moved by little, no reading passes it.
            for step in (_STEP * (abs(theta[name]) or 1.0), (high - low) / 4 / self.units[name].per_si):
                moved = self.values(readings, {**theta, name: theta[name] + step})
                with np.errstate(invalid="ignore"):  # far away, an exponential is infinite
                    slope = ((moved - columns) / step).sum(axis=1, keepdims=True)
                if slope.any():
                    break
            slopes.append(slope)
        return np.concatenate(slopes, axis=1)

    def _middle(self, parameter: FormulaParameter, name: str) -> float:
        low, high = parameter.range or (0.0, 0.0)
        value = parameter.value if parameter.value is not None else 0.5 * low + 0.5 * high
        return (value or 0.25 * low + 0.75 * high) / self.units[name].per_si


def _refuse_names(keys: FormulaKeys, used: tuple[str, ...]) -> None:
    taken = {*VARIABLES, *parsing.CONSTANTS, *parsing.FUNCTIONS}
    for name in keys.parameters:
        if not _NAME.fullmatch(name) or name in taken:
            raise FormulaError(f"a parameter cannot be called {name!r}")
        if name not in used:
            raise FormulaError(f"the parameter {name} does not stand in it")


def _units(keys: FormulaKeys, names: tuple[str, ...], kind: AxisKind) -> dict[str, UnitOf]:
    per_si = MILLIMETRE.per_si if kind is AxisKind.LINEAR else DEGREE.per_si
    found = {
        "P": UnitOf(TRAVEL, per_si),
        "D": UnitOf(NUMBER),
        "t": UnitOf(TIME),
        "run": UnitOf(NUMBER),
        "v": UnitOf(TRAVEL.combined(TIME, -1), 60.0 * per_si),
    }
    for name, each in keys.parameters.items():
        if each.spelled not in UNITS[kind]:
            raise FormulaError(f"{name}: {each.unit!r} does not belong to a {kind.value} axis")
        found[name] = UNITS[kind][each.spelled]
    for name in names:
        found.setdefault(name, UnitOf(TEMPERATURE if name.endswith("temperature") else NUMBER))
    return found


def _linear(terms: tuple[tuple[Tree, ...], ...], parameters: list[str]) -> tuple[str, ...]:
    """Return the parameters that are factors of whole terms, one for each term."""
    found: list[str] = []
    for name in parameters:
        holding = [term for term in terms if any(name in names_in(factor) for factor in term)]
        alone = all(
            sum(name in names_in(factor) for factor in term) == 1 and Name(name) in term for term in holding
        )
        if alone and not any(_is_one_of(factor, found) for term in holding for factor in term):
            found.append(name)
    for term in terms:
        if not any(_is_one_of(factor, found) for factor in term):
            raise FormulaError("each term must have a size to be estimated, as a in a*sin(P/L)")
    return tuple(name for name in parameters if name in found)


def _multiplied_with(name: str, terms: tuple[tuple[Tree, ...], ...]) -> Tree:
    """Return what a parameter is multiplied with: of each of its terms the other factors."""
    products = []
    for term in terms:
        if Name(name) in term:
            factors = [each for each in term if each != Name(name)] or [Number(1.0)]
            products.append(reduce(lambda one, other: Call("*", (one, other)), factors))
    return reduce(lambda one, other: Call("+", (one, other)), products)


def _is_one_of(factor: Tree, names: tuple[str, ...] | list[str]) -> TypeGuard[Name]:
    return isinstance(factor, Name) and factor.text in names
