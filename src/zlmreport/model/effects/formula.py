"""An effect that a formula defines: parameters, forms, job keys, what it needs of test and job, its words."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Field, create_model

from zlmreport.job.formula import Call, Number, Tree, compute, find_calls_in, find_names_in, parse_formula
from zlmreport.job.formula_keys import UNITS_OF_PARAMETERS, FormulaKeys, FormulaParameter, Search
from zlmreport.job.formula_parts import AXIS_KEYS, TABLES, UNITS, Formula, find_kinds_of, find_nearest_known
from zlmreport.job.types import Options
from zlmreport.language import Words, named, same
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import (
    CHOSEN_RANGES,
    Confusion,
    Dimension,
    Effect,
    NamedValue,
    Parameter,
    Shape,
    find_unit_of,
    needs_both_directions,
    needs_linear_axis,
    needs_logged,
    needs_moments,
    needs_passing_time,
    needs_pause,
    needs_rotary_axis,
    needs_runs,
    needs_stated,
    needs_targets,
    needs_whole_period,
)
from zlmreport.model.effects.harmonic import make_harmonic_parameters
from zlmreport.model.effects.readings import LOGS_OF_AIR, collect_readings_of, find_logged_rise
from zlmreport.model.effects.searching import COUNTED, NOT_REFINED, choose_values_of, search_grid

#: Steps that find a joint between two positions, each to half the distance.
_HALVINGS = 40
#: Functions that repeat with their argument, that fade with it, and that jump or bend where it is zero.
_WAVES = frozenset({"sin", "cos", "tan"})
_FADING = frozenset({"exp", "tanh", "atan"})
_JOINTS = frozenset({"step", "sign", "abs", "min", "max", "floor"})
_STATED = Words("stated where the formula is written; no standard states them")
_LOOK = Words("The residuals follow {formula}.")
_MEANING = Words("parameter of {formula}")
_MISSPELLED = Words("no column {column} was logged beside the readings; did you mean {nearest}?")
_AGAIN = Words("{title}, number {number}")
_KNOWN = {
    "published": Words("published"),
    "derived": Words("derived by algebra"),
    "experience": Words("engineering experience; no standard states it"),
}
#: Of a value that the job states, the harmonics by which another is no other.
_HARMONICS, _SAME = np.arange(1, 5), 1e-3


class FormulaEffect(Effect):
    """An effect that is written as a formula in a file.

    Raises `FormulaError` if it cannot be meant for an axis of this kind.

    `keys`: What the file says of it.
    `kind`: Of the axis; without it the effect is for every kind whose units its parameters have, and those of
        a linear axis stand for their like on a rotary one.
    `settings`: The values of its job keys in this form of it.
    `number`: For which time it stands in a model.
    """

    def __init__(
        self,
        keys: FormulaKeys,
        kind: AxisKind | None = None,
        settings: Options | None = None,
        number: int = 1,
    ) -> None:
        self.keys = keys  #: As the file says it.
        self.options = make_options_of(keys)
        self.settings = settings or self.options()
        self._kind, self._number = kind, number
        #: In SI, and parted into what is solved and what is searched.
        self.formula = Formula.of(
            keys, kind or (find_kinds_of(keys) or list(AxisKind))[0], *self._describe_form()
        )
        title = keys.title or same(keys.name)
        self.identifier = keys.name if number == 1 else f"{keys.name}-{number}"
        self.title = title if number == 1 else _AGAIN.given(title=title, number=number)
        self.equation = keys.equation or keys.formula
        self.physics = keys.physics
        self.remedy = keys.remedy
        self.look = keys.look or _LOOK.given(formula=keys.formula)
        self.ranges_from = keys.ranges_from or (CHOSEN_RANGES if keys.look else _STATED)
        self.source = _say_source(keys)
        self.confusions = tuple(Confusion(*each) for each in keys.taken_for.items())
        self.contains = keys.contains
        self.measurands = keys.acts_on
        self.several = keys.several
        self.common = keys.common
        self._ways = self._list_searched()
        parameters = {
            each.name: each
            for name in keys.parameters
            for each in self._list_parameters(name, self.formula.parts.get(name))
        }
        self.linear = tuple(parameters[name] for name in self.formula.linear)
        self.searched = tuple(parameters[name] for name in self.formula.searched)
        self.shape = self._find_shape()
        self.takes, self.denies = self._list_keys_of_axis()

    def _describe_form(self) -> tuple[tuple[int, ...] | None, Mapping[str, str]]:
        """Return the harmonics of this form, and the values of the keys that choose it."""
        harmonics = getattr(self.settings, "harmonics", None) if self.keys.harmonics else None
        return harmonics, {each.name: str(getattr(self.settings, each.name)) for each in self.keys.keys}

    def _is_other(self, parameter: FormulaParameter) -> bool:
        """Return whether other values of a parameter are tried than that which the axis states."""
        return parameter.instead is not None and getattr(self.settings, parameter.instead.key) == OTHER

    def _list_searched(self) -> dict[str, Search | FloatArray]:
        """Return where the search for parameters begins of which not every value in a range makes sense."""
        found: dict[str, Search | FloatArray] = {}
        for name, each in self.keys.parameters.items():
            values = self.formula.list_sensible(name)
            if each.instead and self._is_other(each):
                found[name] = np.array(each.instead.values) / self.formula.units[name].per_si
            elif values is not None:
                found[name] = values
            elif each.search:
                found[name] = each.search
        return found

    def _list_parameters(self, name: str, parts: tuple[str, ...] | None) -> tuple[Parameter, ...]:
        own, per_si = self.keys.parameters[name], self.formula.units[name].per_si
        low, high = (None if each is None else each / per_si for each in own.range or (None, None))
        usual = None if own.usual is None else (own.usual[0] / per_si, own.usual[1] / per_si)
        on_rotary = own.usual_on_rotary
        if on_rotary is not None:
            there = UNITS[AxisKind.ROTARY][UNITS_OF_PARAMETERS.get(own.spelled, own.spelled)].per_si
            on_rotary = (on_rotary[0] / there, on_rotary[1] / there)
        if parts:
            sizes = make_harmonic_parameters(self._describe_form()[0] or (1,), high or np.inf)
            return tuple(
                replace(each, usual=usual, usual_on_rotary=on_rotary, question=own.question) for each in sizes
            )
        kind = self._kind or (
            AxisKind.LINEAR if AxisKind.LINEAR in find_kinds_of(self.keys) else AxisKind.ROTARY
        )
        way = self._ways.get(name)
        of_list = way is not None and not isinstance(way, Search)
        # Beside a usual pitch there are others; of teeth there is no number between two.
        is_between = own.instead is not None and own.search not in NOT_REFINED
        return (
            Parameter(
                name,
                own.notation or name,
                next(each for each in Dimension if find_unit_of(each, kind).ascii == own.spelled),
                own.meaning or _MEANING.given(formula=self.keys.formula),
                low,
                high,
                is_refined=is_between if of_list else way not in NOT_REFINED,
                is_counted=own.search in COUNTED,
                usual=usual,
                usual_on_rotary=on_rotary,
                question=own.question,
                question_below=own.question_below,
                named=tuple(
                    NamedValue(each.between[0] / per_si, each.between[1] / per_si, each.says)
                    for each in own.meanings
                ),
                instead_of=own.stated if self._is_other(own) and own.stated in AXIS_KEYS else None,
            ),
        )

    def _find_shape(self) -> Shape:
        names = self.formula.names
        if {"t", "v", "air_index"} & {*names} or self.formula.columns:
            return Shape.TIME
        if "run" in names:
            return Shape.RUN
        return Shape.DIRECTION if "D" in names else Shape.POSITION

    def _list_keys_of_axis(self) -> tuple[frozenset[str], frozenset[str]]:
        """Return the keys of the axis whose values it takes, and those in whose place it has others."""
        taken, denied = {*self.formula.names} - self.keys.parameters.keys(), set[str]()
        for name, each in self.keys.parameters.items():
            if each.stated:
                names = find_names_in(parse_formula(each.stated))
                if self._is_other(each):
                    denied.update(names)
                elif name not in self._ways:
                    taken.update(names)
        return frozenset(taken.intersection(AXIS_KEYS)), frozenset(denied.intersection(AXIS_KEYS))

    def with_settings(self, settings: Any) -> Effect:
        """Return the form of the effect that its job keys ask for."""
        if settings == self.settings:
            return self
        return FormulaEffect(self.keys, self._kind, settings, self._number)

    def repeated(self, number: int) -> Effect:
        """Return the effect as it stands in a model for the second time, or the third."""
        if not self.several or number == self._number:
            return self
        return FormulaEffect(self.keys, self._kind, self.settings, number)

    def forms(self) -> tuple[Effect, ...]:
        """Return a form for each choice, for each set of harmonics that is tried, and for other periods."""
        return tuple(map(self.with_settings, list_tried_settings(self.keys, self.options)))

    def further_forms(self) -> tuple[Effect, ...]:
        """Return the forms with more harmonics; of another period than the usual one too, it staying so."""
        harmonics = self.keys.harmonics
        if harmonics is None:
            return ()
        others = self.settings.model_dump(exclude={"harmonics"}, exclude_defaults=True)
        tried = (*harmonics.tried, *harmonics.further) if others else harmonics.further
        settings = ({**others, "harmonics": each} for each in tried)
        return tuple(self.with_settings(self.options.model_validate(each)) for each in settings)

    def untestable(self, design: Design) -> Words | None:
        """Demand what stands in the formula, and what the file says that it needs beside."""
        needs, names = self.keys.needs, self.formula.names
        logs = (
            *self.formula.columns,
            *(LOGS_OF_AIR if "air_index" in names else ()),
            *(("v",) if "v" in names else ()),
        )
        return (
            (needs_rotary_axis(design) if "turn" in names or needs.axis == "rotary" else None)
            or (needs_linear_axis(design) if needs.axis == "linear" else None)
            or (needs_both_directions(design) if needs.both_directions else None)
            or self._say_unstated(design.axis)
            or self._say_without_period(design)
            or self._say_misspelled(design)
            or needs_logged(design, *logs)
            or (needs_passing_time(design) if "t" in names else None)
            or needs_targets(design, needs.targets or 1)
            or needs_runs(design, needs.runs or 1)
            or (needs_moments(design) if self._is_searched(Search.MOMENT) else None)
            or (needs_pause(design) if self._is_searched(Search.PAUSE) else None)
        )

    def _say_misspelled(self, design: Design) -> Words | None:
        """Return which column is not logged, and looks like the name of something else in the formula."""
        for column in self.formula.columns:
            if column not in design.conditions and column not in CONDITIONS:
                nearest = find_nearest_known(column, self.keys, design.conditions)
                if nearest:
                    return _MISSPELLED.given(column=column, nearest=nearest)
        return None

    def _is_searched(self, way: Search) -> bool:
        return any(each is way for each in self._ways.values())

    def _say_unstated(self, axis: Axis) -> Words | None:
        """Return which key of the axis a formula has and the job does not state."""
        known = {*AXIS_KEYS, *TABLES} - self.keys.parameters.keys()
        keys = [TABLES.get(name, name) for name in self.formula.names if name in known]
        for parameter in self.searched:
            own = self.keys.parameters[parameter.name]
            # Other values than a stated one make no sense without it where all values are searched.
            is_needed = parameter.name not in self._ways or (self._is_other(own) and own.search)
            if own.stated and is_needed:
                keys.extend(name for name in find_names_in(parse_formula(own.stated)) if name in AXIS_KEYS)
        return next((why for key in keys if (why := needs_stated(getattr(axis, key), f"axis.{key}"))), None)

    def _say_without_period(self, design: Design) -> Words | None:
        """Return that the measured travel holds no whole period of those that are tried."""
        key = self.keys.needs.whole_period
        if key is None or any(map(self._is_other, self.keys.parameters.values())):
            return None
        return needs_whole_period(design, getattr(design.axis, key), f"axis.{key}")

    def forbids(self, design: Design, values: Mapping[str, float]) -> Words | None:
        """Return why physics and the log of a test forbid values of parameters, SI."""
        for name, value in values.items():
            possible = self.keys.parameters[name].possible if name in self.keys.parameters else None
            if possible is not None:
                low, high = self.formula.compute_bounds(name, find_logged_rise(design))
                if not low <= value <= high:
                    return possible.because
        return None

    def grid(self, design: Design) -> FloatArray:
        """Return values that a search begins with; those that are given or stated are known."""
        stated = self._read_axis(design.axis)
        ways, known = dict(self._ways), self.formula.given | stated
        for name, own in self.keys.parameters.items():
            if own.instead is None:
                continue
            usual = np.array(own.instead.values) / self.formula.units[name].per_si
            if self._is_other(own):
                value = known.pop(name, None)
                others = (
                    usual if value is None else _drop_harmonics(usual, value, is_count=own.spelled == "1")
                )
                ways[name] = others
            elif name not in known:
                ways[name] = np.union1d(choose_values_of(ways[name], design), usual)
        found = search_grid(design, self.searched, known, ways)
        skipped = self._number - 1  # which of several is which says their order
        return found[skipped:] if skipped < len(found) else found

    def expected(self, axis: Axis) -> dict[str, float]:
        """Return what the job states of parameters, and the values that they have if this is the cause."""
        expected = {
            name: each.expected / self.formula.units[name].per_si
            for name, each in self.keys.parameters.items()
            if each.expected is not None
        }
        return self._read_axis(axis) | expected

    def _read_axis(self, axis: Axis) -> dict[str, float]:
        """Return the values of parameters that keys of the axis state, SI."""
        keys = {name: getattr(axis, name) for name in AXIS_KEYS} | {"turn": 2 * np.pi}
        found = {}
        for parameter in (*self.linear, *self.searched):
            value = self.formula.find_stated(parameter.name, keys)
            if value is not None:
                whole = self.keys.parameters[parameter.name].search is Search.WHOLE_NUMBER
                found[parameter.name] = float(round(value)) if whole else value
        return found

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        """Return what each linear parameter is multiplied with."""
        return self.formula.compute_values(self._list_readings(design), self._name_searched(theta))

    def find_shortest_wave(self, along: Design, theta: FloatArray) -> float:
        """Return the length of the shortest wave at rising positions, m or rad; infinite without any."""
        calls = find_calls_in(self.formula.tree, _WAVES)
        phases = [
            self._restrict_to_position(call.arguments[0], along, theta)(along.position) for call in calls
        ]
        return 2 * np.pi * _find_shortest(along, phases)

    def find_shortest_fading(self, along: Design, theta: FloatArray) -> float:
        """Return the shortest length over which a part of it comes or goes, m or rad; infinite without."""
        calls = find_calls_in(self.formula.tree, _FADING)
        values = [self._restrict_to_position(call, along, theta)(along.position) for call in calls]
        return _find_shortest(along, [value / np.abs(value).max() for value in values if value.any()])

    def find_joints(self, along: Design, theta: FloatArray) -> list[float]:
        """Return where it jumps or bends between rising positions, m or rad."""
        found: list[float] = []
        for call in find_calls_in(self.formula.tree, _JOINTS):
            zero = Call("-", call.arguments) if len(call.arguments) > 1 else call.arguments[0]
            if call.operation == "floor":  # it jumps at every whole number
                zero = Call("sin", (Call("*", (Number(np.pi), zero)),))
            value = self._restrict_to_position(zero, along, theta)
            signs = np.nan_to_num(np.sign(value(along.position)))
            before = np.flatnonzero(np.diff(signs))
            low, high = along.position[before], along.position[before + 1]
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                is_low = np.sign(value(middle)) == signs[before]
                low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
            found += low.tolist()
        for key in {TABLES[name] for name in self.formula.names if name in TABLES}:
            found += getattr(along.axis, key).positions
        return found

    def _restrict_to_position(
        self, part: Tree, along: Design, theta: FloatArray
    ) -> Callable[[FloatArray], FloatArray]:
        """Return a part of the formula as a function of the position, all else being as in a design."""
        readings = {name: np.ravel(values)[0] for name, values in self._list_readings(along).items()}
        known = readings | self._name_searched(theta)
        return lambda places: np.broadcast_to(compute(part, {**known, "P": places}), places.shape)

    def _name_searched(self, theta: FloatArray) -> dict[str, float]:
        names = [parameter.name for parameter in self.searched]
        return dict(zip(names, theta.tolist(), strict=True))

    def _list_readings(self, design: Design) -> dict[str, FloatArray | float]:
        """Return what stands in the formula, but for its parameters; positions in any case."""
        own = {*self.formula.linear, *self.formula.searched}
        names = (name for name in self.formula.names if name not in own)
        return collect_readings_of(design, names, self.formula.units)


def _say_source(keys: FormulaKeys) -> Words | None:
    """Return how the form of an effect is known; nothing of a formula that a job tries."""
    if keys.look is None and keys.source is None:
        return None
    known = _KNOWN[keys.known]
    return known if keys.source is None else named(known, keys.source)


def _drop_harmonics(values: FloatArray, stated: float, *, is_count: bool) -> FloatArray:
    """Return values that are not the stated one, nor one of its harmonics."""
    order = values / stated if is_count else stated / values
    is_same = np.any(np.abs(order[:, np.newaxis] - _HARMONICS) < _SAME * _HARMONICS, axis=1)
    return values[~is_same] if not np.all(is_same) else values


def _find_shortest(along: Design, values: list[FloatArray]) -> float:
    """Return the shortest length in which one of some values changes by 1; infinite if none does."""
    with np.errstate(all="ignore"):
        slopes = np.abs(np.diff(np.array(values)) / np.diff(along.position)) if values else np.zeros(1)
        return float(1.0 / slopes[np.isfinite(slopes)].max(initial=0.0))


#: Values of a key of `Instead`.
STATED, OTHER = "stated", "other"
_WHOLE_NUMBER = re.compile("-?[0-9]{1,9}")


def _require_distinct(orders: tuple[int, ...]) -> tuple[int, ...]:
    if len(set(orders)) < len(orders):
        raise ValueError("a harmonic stands there twice; each is named once, as in [1, 2]")
    return orders


_ORDERS: Any = Annotated[tuple[Annotated[int, Field(ge=1, le=4)], ...], AfterValidator(_require_distinct)]


@cache
def _make_options(
    usual: tuple[int, ...], chosen: tuple[tuple[str, str, tuple[str | int, ...]], ...]
) -> type[Options]:
    """Return the model of keys: of harmonics, and of choices by name, description and values."""
    fields: dict[str, Any] = {}
    if usual:
        description = "Harmonics of the period, 1 to 4: 1 is once a period."
        fields["harmonics"] = (_ORDERS, Field(usual, min_length=1, description=description))
    for name, described, values in chosen:
        fields[name] = (Literal[values], Field(values[0], description=described))
    return create_model("FormOptions", __base__=Options, **fields) if fields else Options


def make_options_of(keys: FormulaKeys) -> type[Options]:
    """Return the job keys of an effect beside its parameters, the usual form being that which names none."""
    chosen: list[tuple[str, str, tuple[str | int, ...]]] = [
        (each.name, each.description, tuple(map(_read_value, each.choices))) for each in keys.keys
    ]
    chosen.extend(
        (each.instead.key, each.instead.description, (STATED, OTHER))
        for each in keys.parameters.values()
        if each.instead
    )
    return _make_options(keys.harmonics.usual if keys.harmonics else (), tuple(chosen))


def list_tried_settings(keys: FormulaKeys, options: type[Options]) -> Iterator[Options]:
    """Yield the settings of the forms that a diagnosis tries: one key at a time, the others being usual."""
    if keys.harmonics:
        for orders in keys.harmonics.tried:
            yield options.model_validate({"harmonics": orders})
    else:
        yield options()
    for key in keys.keys:
        for choice in list(key.choices)[1:]:  # the first is the usual form
            yield options.model_validate({key.name: _read_value(choice)})
    for each in keys.parameters.values():
        if each.instead:
            plainest = {"harmonics": (1,)} if keys.harmonics else {}
            yield options.model_validate({**plainest, each.instead.key: OTHER})


def _read_value(text: str) -> str | int:
    """Return the value of a key as a job has it: a whole number where it is written like one."""
    return int(text) if _WHOLE_NUMBER.fullmatch(text) else text
