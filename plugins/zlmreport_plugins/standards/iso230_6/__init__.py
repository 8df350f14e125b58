"""ISO 230-6:2002, diagonal displacement tests: body diagonals of the work space, and those of its faces.

That the test is an index for comparison and acceptance and no diagnosis, and that a pair of face diagonals
shows a squareness error, is published. The formulas, the plan of a test and the names of face diagonals are
this program's reading.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

import numpy as np
from pydantic import Field, model_validator

from zlmreport.plugin import (
    MILLIMETRE,
    Approach,
    Evaluation,
    Figure,
    Finite,
    FloatArray,
    JobPart,
    MeasurementSet,
    Options,
    PartRow,
    Words,
    hookimpl,
    same_in_all_languages,
)
from zlmreport.plugin.standard import (
    APPROACH_TITLES,
    MEAN_ROLES,
    Arithmetic,
    Basis,
    Curve,
    Finding,
    Information,
    Panel,
    PositionQuantity,
    PositionStatistics,
    Standard,
    both_directions,
    deviation_in_words,
    exceeds,
    measured_length,
    no_missing_readings,
    number_of_runs,
    position_in_words,
    positions_per_metre,
    span_over_positions,
    worst_of_lines,
)
from zlmreport_plugins.standards.iso230_6.quantities import BODY, DIAGONALS, FACE, FACES, QUANTITIES

_PER_METRE, _AT_LEAST, _RUNS = 5, 5, 5
#: Positions without which there is no length.
_ENDS = 2
#: The sign of each squareness error by the difference of both diagonals of its plane.
_SIGNS = {"C0Y": -1.0, "B0Z": 1.0, "A0Z": -1.0}
#: Of the graphs beside each other, mm.
_HEIGHT = 60.0
#: Of a diagonal that may seem longer than its axes let it be, as targets are rounded.
_ROUNDING = 1e-3
#: Of a diagonal, what must be measured at least: what lies outside is not in its parameters.
_WHOLE = 0.9


class SpaceKeys(JobPart):
    """The work space: from where to where each axis moves along its diagonals."""

    X: tuple[Finite, Finite] | None = Field(None, description="Of X, mm.", examples=[[0, 500]])
    Y: tuple[Finite, Finite] | None = Field(None, description="Of Y, mm.", examples=[[0, 400]])
    Z: tuple[Finite, Finite] | None = Field(None, description="Of Z, mm.", examples=[[0, 300]])

    @model_validator(mode="after")
    def _refuse_falling(self) -> SpaceKeys:
        for name in type(self).model_fields:
            ends = getattr(self, name)
            if ends and ends[0] >= ends[1]:
                raise ValueError(f"{name}: the first position must be less than the last")
        return self

    def find_side(self, axis: str) -> float | None:
        """Return how far an axis moves, m; None where nobody stated it."""
        ends = getattr(self, axis)
        return float(MILLIMETRE.to_si(ends[1] - ends[0])) if ends else None

    def compute_diagonal(self, axes: str) -> float | None:
        """Return the diagonal over some of the axes, m; None where one of them is not stated."""
        sides = [self.find_side(axis) for axis in axes]
        known = [side for side in sides if side is not None]
        return math.hypot(*known) if len(known) == len(sides) else None


class DiagonalOptions(Options):
    """The work space that the diagonals cross."""

    of_the_measurement = ("axes",)

    axes: SpaceKeys = Field(
        SpaceKeys(), description="The work space that the diagonals cross.", examples=[{"X": [0, 500]}]
    )


_INDEX = Words(
    "The diagonal test is an index by which machines are compared and accepted, and no diagnosis: errors of "
    "axes may cancel along a diagonal, as those of two scales of which one is too long and the other too "
    "short."
)
_NAMES = Words(
    "P and N are the signs of the directions of X, Y and Z from the first position of a diagonal to its "
    "last. E and B with the index d are the largest of the four body diagonals (this program's reading)."
)


class Iso230Part6:
    """ISO 230-6 in the edition of 2002."""

    identifier = "iso230-6:2002"
    designation = "ISO 230-6:2002"
    title = Words("Diagonal displacement tests of the work space")
    position_index = "i"
    options: type[Options] = DiagonalOptions
    measurands = (DIAGONALS,)
    information = (Information.COMPENSATION, Information.TEMPERATURES, Information.INSTRUMENT)
    quantities = QUANTITIES
    position_quantities: tuple[PositionQuantity, ...] = ()
    notes: tuple[Words, ...] = (_INDEX, _NAMES)

    def requirements(self, measurements: MeasurementSet, options: DiagonalOptions) -> Iterator[Finding]:
        """Hold the plan of the test against the lines that were measured."""
        tests = measurements.tests
        yield _check_four(tests)
        for rule in (
            lambda each: positions_per_metre(each, _PER_METRE, Basis.APPLIED, minimum=_AT_LEAST),
            lambda each: number_of_runs(each, _RUNS, Basis.APPLIED),
            lambda each: both_directions(each, _ONE_DIRECTION, Basis.APPLIED),
            no_missing_readings,
        ):
            if tests:
                yield worst_of_lines(tests, rule)
        yield from _check_within(tests, options.axes)
        yield from _check_whole(tests, options.axes)

    def arithmetic(self, statistics: PositionStatistics, options: DiagonalOptions) -> Arithmetic:
        """Return the parameters of each diagonal that was measured, the largest, and what faces show."""
        batch = statistics.mean.shape[:-2]
        found = {each.symbol: np.full(batch, np.nan) for each in QUANTITIES}
        for name, line in statistics.tests.items():
            if name in (*BODY, *FACE):
                found |= _compute_of_one(name, line)
        for letter in "EB":
            of_body = np.stack([found[f"{letter}_{name}"] for name in BODY])
            # The largest of some of them says nothing of those that are not there.
            found[f"{letter}_d"] = np.maximum.reduce(of_body)
        for symbol, (first, second) in FACES.items():
            if first in statistics.tests and second in statistics.tests:
                found[symbol] = squareness(
                    symbol, statistics.tests[first], statistics.tests[second], options.axes
                )
        return Arithmetic(found)

    def figures(self, evaluation: Evaluation, options: DiagonalOptions) -> Iterator[Figure]:  # noqa: ARG002 - no key of its own
        """Yield the mean deviations along body diagonals, and along those of faces."""
        tests = evaluation.measurements.tests
        for key, names, title in (("body", BODY, _OF_BODY), ("faces", FACE, _OF_FACES)):
            shown = [name for name in names if name in tests]
            if not shown:
                continue
            axis = tests[shown[0]].axis
            yield Figure(
                key=key,
                title=title,
                alternative=_SEEN.given(
                    values=same_in_all_languages(PartRow(tuple(shown))),
                    largest=_say_largest(evaluation, shown),
                ),
                x_title=_ALONG,
                y_title=_DEVIATION,
                x_unit=axis.position_unit.symbol,
                y_unit=axis.deviation_unit.symbol,
                panels=tuple(
                    _make_panel(name, tests[name], evaluation.statistics.tests[name]) for name in shown
                ),
                is_wide=True,
                height=_HEIGHT,
            )


def squareness(
    symbol: str, first: PositionStatistics, second: PositionStatistics, space: SpaceKeys
) -> FloatArray:
    """Return the squareness error of a plane by how much longer one of its diagonals is, rad, shape (...).

    With sides a and b, D² = a² + b², the angle between the axes is smaller than 90° by
    (ε_1 − ε_2)·D²/(2ab); ε is the elongation of each diagonal. NaN where a side is not stated.
    """
    axes = FACES[symbol][0]
    a, b = space.find_side(axes[0]), space.find_side(axes[1])
    if a is None or b is None:
        return np.full(first.mean.shape[:-2], np.nan)
    smaller = (_compute_elongation(first) - _compute_elongation(second)) * (a * a + b * b) / (2 * a * b)
    return _SIGNS[symbol] * smaller


def _compute_elongation(line: PositionStatistics) -> FloatArray:
    """Return by how much of its length a diagonal is too long, from its ends, shape (...).

    NaN where it has one position only, and so no length.
    """
    if len(line.positions) < _ENDS:
        return np.full(line.mean.shape[:-2], np.nan)
    mean = line.mean_of_all_runs
    return np.asarray((mean[..., -1] - mean[..., 0]) / (line.positions[-1] - line.positions[0]))


def _compute_of_one(name: str, line: PositionStatistics) -> dict[str, FloatArray]:
    mean = line.mean
    if len(line.positions) < _ENDS:
        mean = np.full_like(mean, np.nan)  # a length needs two positions
    of_each, both = span_over_positions(mean), mean.reshape(*mean.shape[:-2], -1)
    return {
        f"E_{name}": np.where(line.is_bidirectional, span_over_positions(both), np.nan),
        f"E_{name}_fwd": of_each[..., Approach.POSITIVE.index],
        f"E_{name}_bwd": of_each[..., Approach.NEGATIVE.index],
        f"B_{name}": np.fmax.reduce(np.abs(line.reversal_value), axis=-1, initial=np.nan),
    }


def _name_axes_of(name: str) -> str:
    return "XYZ" if name in BODY else name[:2]


def _check_four(tests: Mapping[str, MeasurementSet]) -> Finding:
    """Ask for all body diagonals; faces alone are a test of squareness."""
    lacking = [name for name in BODY if name not in tests]
    found = _ALL_FOUR if not lacking else _LACKING.given(names=", ".join(lacking))
    return Finding(_FOUR, found, not lacking, Basis.APPLIED)


def _check_within(tests: Mapping[str, MeasurementSet], space: SpaceKeys) -> Iterator[Finding]:
    """Yield whether the diagonals have room in the work space as it is stated."""
    for name, line in tests.items():
        whole, measured = space.compute_diagonal(_name_axes_of(name)), measured_length(line)
        if whole is None:
            yield Finding(_IN_SPACE, _NOT_STATED, None)
            return
        if exceeds(measured, whole * (1 + _ROUNDING)):
            said = _TOO_LONG.given(
                name=name,
                measured=position_in_words(line.axis, measured),
                whole=position_in_words(line.axis, float(f"{whole:.6g}")),
            )
            yield Finding(_IN_SPACE, said, met=False)
            return
    yield Finding(_IN_SPACE, _THEY_ARE, met=True)


def _check_whole(tests: Mapping[str, MeasurementSet], space: SpaceKeys) -> Iterator[Finding]:
    """Yield whether each diagonal was measured over the work space, or over as much as others of its kind."""
    lengths = {name: measured_length(line) for name, line in tests.items() if name in (*BODY, *FACE)}
    if not lengths:
        return
    wholes = {
        name: space.compute_diagonal(_name_axes_of(name))
        or max(length for other, length in lengths.items() if _name_axes_of(other) == _name_axes_of(name))
        for name in lengths
    }
    name = min(lengths, key=lambda each: lengths[each] / wholes[each] if wholes[each] else 1.0)
    axis, whole = tests[name].axis, float(f"{wholes[name]:.6g}")
    if lengths[name] >= _WHOLE * wholes[name]:
        yield Finding(_OVER_WHOLE, _THEY_ARE, met=True)
        return
    said = _TOO_SHORT.given(
        name=name,
        measured=position_in_words(axis, lengths[name]),
        whole=position_in_words(axis, whole),
    )
    yield Finding(_OVER_WHOLE, said, met=False)


def _say_largest(evaluation: Evaluation, names: Iterable[str]) -> Words:
    """Return the largest deviation of some diagonals over both directions in words."""
    values = [value for name in names if (value := evaluation.value(f"E_{name}")) is not None]
    if not values:
        return _NOT_DEFINED
    any_line = next(iter(evaluation.measurements.tests.values()))
    return deviation_in_words(any_line.axis, float(f"{max(values):.4g}"))


def _make_panel(name: str, line: MeasurementSet, statistics: PositionStatistics) -> Panel:
    axis = line.axis
    shown = axis.position_unit.from_si(line.target_positions)
    return Panel(
        heading=_HEADING.given(name=name, length=position_in_words(axis, measured_length(line))),
        curves=tuple(
            Curve(
                f"x̄_{{i}}{approach.arrow}",
                MEAN_ROLES[approach],
                shown,
                axis.deviation_unit.from_si(statistics.mean[approach.index]),
            )
            for approach in APPROACH_TITLES
            if statistics.is_measured[approach.index]
        ),
    )


_FOUR = Words("All four body diagonals: PPP, NPP, PNP, NNP")
_ALL_FOUR = Words("all four")
_LACKING = Words("{names} not measured; E_d and B_d are not reported")
_ONE_DIRECTION = Words("E and B of both directions are not reported")
_IN_SPACE = Words("Diagonals within the work space (axes)")
_OVER_WHOLE = Words("Diagonals measured over nine tenths of their length in the work space at least")
_TOO_SHORT = Words("{name} was measured over {measured} of {whole}")
_NOT_STATED = Words("not stated")
_THEY_ARE = Words("they are", context="all are")
_TOO_LONG = Words("{name} was measured over {measured}, the work space has {whole}")
_OF_BODY = Words("Mean deviations along the body diagonals, on one scale")
_OF_FACES = Words("Mean deviations along the face diagonals, on one scale")
_SEEN = Words(
    "Graphs of the mean deviation over the position on the diagonals {values}; largest systematic deviation: "
    "{largest}."
)
_HEADING = Words("{name}, {length}")
_NOT_DEFINED = Words("not defined")
_ALONG = Words("Position along the diagonal")
_DEVIATION = Words("Deviation")


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Offer the edition of 2002."""
    return (Iso230Part6(),)
