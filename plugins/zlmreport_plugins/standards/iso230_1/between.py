"""What two measured lines give together: squareness and parallelism.

The angle between two axes is that between their reference lines, so that its value depends on the line that
was chosen. With m_1 and m_2, the slopes of the two straightness errors in the directions of each other's axes
(EYX over X and EXY over Y), the X path turns by m_1 about +Z and the Y path by −m_2: C0Y, the turn of Y
against X, is −(m_1 + m_2). The same algebra gives A0Z, and B0Z with the opposite sign, for a right-handed
turn of Z about +Y leans towards +X. The artefact's own angle − 90° is added to the angle of the axes that was
measured against it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    ARCSECOND,
    MICROMETRE_PER_METRE,
    MILLIMETRE,
    ErrorSymbol,
    Evaluation,
    Figure,
    Finite,
    FloatArray,
    JobPart,
    Measurand,
    MeasurementSet,
    Positive,
    TextLine,
    Words,
    named,
    same_in_all_languages,
)
from zlmreport.plugin.extension import (
    STATED_COVERAGE_FACTOR,
    USUAL_CONTRIBUTIONS,
    Acts,
    Contribution,
    Distribution,
    calibration_in_words,
    expanded_uncertainty_in_words,
)
from zlmreport.plugin.standard import (
    Curve,
    Finding,
    Panel,
    PositionStatistics,
    Role,
    deviation_in_words,
    position_in_words,
)
from zlmreport_plugins.standards.iso230_1.figures import LINES
from zlmreport_plugins.standards.iso230_1.reference_lines import (
    FEWEST_POSITIONS,
    LineName,
    residuals,
    slope_of_several,
)

#: Of the turn of one axis against the other, by the sum of both slopes.
_SIGNS = {"C0Y": -1.0, "B0Z": 1.0, "A0Z": -1.0}
#: A lean that is seen in a sketch, of its height.
_LEAN = 0.06
#: Beyond, an angle minus 90° is that of no square, arc seconds: 30″ are 45 µm on 300 mm.
_NO_SQUARE = 30.0
#: Of two places that are said to be one, m.
_ALIKE = 1e-3


class SquareKeys(JobPart):
    """The square, or another artefact, against which both lines were measured."""

    error: Finite = Field(
        0.0, description="Its angle minus 90°, as its certificate states it, arc seconds.", examples=[0.4]
    )
    expanded_uncertainty: Positive | None = Field(
        None, description="Of that angle, k = 2, arc seconds.", examples=[0.5]
    )
    name: TextLine | None = Field(None, description="Which it is.", examples=["Granite square GS 630"])
    certificate: TextLine | None = Field(None, description="Its calibration certificate.")


def compute_values(
    what: ErrorSymbol | Measurand,
    statistics: PositionStatistics,
    line: LineName,
    square: SquareKeys | None,
) -> dict[str, FloatArray]:
    """Return the angle between two lines and their slopes, rad; NaN unless there are two."""
    batch = statistics.mean.shape[:-2]
    slopes = [
        slope_of_several(each.positions, each.mean_of_all_runs, line) for each in statistics.tests.values()
    ]
    if len(slopes) != 2:
        slopes = [np.full(batch, np.nan)] * 2
    first, second = slopes
    if isinstance(what, Measurand):
        return {what.identifier: first - second, "slope_1": first, "slope_2": second}
    artefact = ARCSECOND.to_si(square.error) if square else 0.0
    turned = _SIGNS[what.symbol] * (first + second - artefact)
    return {what.symbol: turned, "slope_1": first, "slope_2": second}


def list_contributions(
    what: ErrorSymbol | Measurand, measurements: MeasurementSet, square: SquareKeys | None
) -> Mapping[str, Sequence[Contribution]]:
    """Return the error of the square's angle: it tilts all readings of the second line alike."""
    if square is None or square.expanded_uncertainty is None or isinstance(what, Measurand):
        return {}
    (*_, (name, line)) = measurements.tests.items()
    length = float(np.ptp(line.target_positions))
    expanded = ARCSECOND.to_si(square.expanded_uncertainty)
    return {
        name: [
            Contribution(
                name=USUAL_CONTRIBUTIONS["square"],
                standard_uncertainty=expanded / STATED_COVERAGE_FACTOR * length,
                acts=Acts.ALONG_THE_LENGTH,
                distribution=Distribution.NORMAL,
                stated=expanded_uncertainty_in_words(
                    square.expanded_uncertainty, ARCSECOND.symbol, STATED_COVERAGE_FACTOR
                ),
                source=calibration_in_words(square.certificate),
                contributor="square",
            )
        ]
    }


def check_requirements(
    what: ErrorSymbol | Measurand, measurements: MeasurementSet, square: SquareKeys | None
) -> Iterator[Finding]:
    """Hold what two lines must have in common against those of a test."""
    lines = tuple(measurements.tests.values())
    errors = [each.axis.error for each in lines]
    if isinstance(what, Measurand):
        yield Finding(_TWO, same_in_all_languages(", ".join(measurements.tests)), len(lines) == len(_PAIR))
    else:
        found = ", ".join(filter(None, errors)) or ", ".join(measurements.tests)
        yield Finding(
            Words("Straightness of both axes, {pair}").given(pair=" + ".join(what.lines)),
            same_in_all_languages(found),
            sorted(errors) == sorted(what.lines),
        )
    fewest = min((len(each.target_positions) for each in lines), default=0)
    number = Words("{number}").given(number=fewest)
    yield Finding(_POSITIONS.given(number=FEWEST_POSITIONS), number, fewest >= FEWEST_POSITIONS)
    if not isinstance(what, Measurand):
        yield _check_meeting(lines)
        yield _check_square(square)


def _check_square(square: SquareKeys | None) -> Finding:
    """Return whether the angle of the square is stated, and is that of one."""
    if square is None or not square.expanded_uncertainty:
        return Finding(_SQUARE_IS_STATED, _NOT_STATED, None)
    if abs(square.error) > _NO_SQUARE:
        turned = _NO_SUCH_SQUARE.given(error=square.error, angle=float(f"{90 + square.error / 3600:.6g}"))
        return Finding(_SQUARE_IS_STATED, turned, met=False)
    return Finding(_SQUARE_IS_STATED, Words("stated"), met=True)


def _check_meeting(lines: Sequence[MeasurementSet]) -> Finding:
    """Return whether the lines lie in one plane, as far as the job says where they lie."""
    places = [dict(each.axis.at) for each in lines]
    moving = {each.axis.name for each in lines}
    common = set.intersection(*(set(each) for each in places)) - moving if places else set()
    if not common:
        return Finding(_MEET, _NOT_STATED, None)
    apart = [
        (name, distance)
        for name in sorted(common)
        if (distance := max(each[name] for each in places) - min(each[name] for each in places)) > _ALIKE
    ]
    if not apart:
        return Finding(_MEET, Words("they are", context="all are"), met=True)
    name, distance = apart[0]
    words = _APART.given(axis=name, distance=position_in_words(lines[0].axis, distance))
    return Finding(_MEET, words, met=False)


def list_notes(what: ErrorSymbol | Measurand) -> Iterator[Words]:
    """Yield what a reader of the angle between two lines must know."""
    if isinstance(what, Measurand):
        yield _OF_PARALLELISM
    else:
        yield _LEANS[what.symbol]
        yield Words("The sign of squareness errors is this program's reading of ISO 230-1.")
    yield _OF_THE_LINES


def draw_figures(what: ErrorSymbol | Measurand, evaluation: Evaluation, line: LineName) -> Iterator[Figure]:
    """Yield both lines with their reference lines, and a sketch of how the axes lean."""
    tests = evaluation.measurements.tests
    if len(tests) != len(_PAIR):
        return
    panels = [
        _make_panel(name, each, evaluation.statistics.tests[name], line) for name, each in tests.items()
    ]
    first = next(iter(tests.values())).axis
    slopes = [evaluation.value(each) for each in _PAIR]
    symbol = evaluation.parameters[0].quantity.symbol if evaluation.parameters else ""
    alternative = _SEEN.given(
        lines=", ".join(tests),
        first=_write_slope(slopes[0]),
        second=_write_slope(slopes[1]),
    )
    yield Figure(
        key="lines",
        title=_LINES.given(symbol=symbol, line=LINES[line]),
        alternative=alternative,
        x_title=_POSITION,
        y_title=_DEVIATION,
        x_unit=first.position_unit.symbol,
        y_unit=first.deviation_unit.symbol,
        panels=tuple(panels),
        spans_are_alike=False,
        is_wide=True,
    )
    if not isinstance(what, Measurand) and evaluation.parameters:
        yield _draw_sketch(what, evaluation)


def _make_panel(
    name: str, measurements: MeasurementSet, statistics: PositionStatistics, line: LineName
) -> Panel:
    axis, x = measurements.axis, measurements.target_positions
    mean = statistics.mean_of_all_runs
    shown = axis.position_unit.from_si(x)
    about = residuals(x, mean, line)
    return Panel(
        heading=named(name, axis.error or axis.name),
        curves=tuple(
            Curve(notation, role, shown, axis.deviation_unit.from_si(each))
            for notation, role, each in (
                ("x̄_{i}", Role.MEAN_BIDIRECTIONAL, mean),
                ("y_{0} + m·P_{i}", Role.BAND_LIMIT, mean - about),
            )
        ),
    )


def _draw_sketch(what: ErrorSymbol, evaluation: Evaluation) -> Figure:
    """Return both axes as they lean, far too much: which way the sign means."""
    value = evaluation.parameters[0].value
    lean = -_SIGNS[what.symbol] * np.sign(value) * _LEAN
    # Away from the first axis is to the left; C0Y > 0 leans there, B0Z > 0 to the right.
    ends = np.array([0.0, 1.0])
    size = max(
        (float(np.ptp(each.target_positions)) for each in evaluation.measurements.tests.values()), default=1.0
    )
    length = MILLIMETRE.from_si(size)
    written = deviation_in_words(evaluation.measurements.axis, float(f"{value:.3g}"))
    way = _AWAY if lean > 0 else _TOWARDS
    return Figure(
        key="sketch",
        title=_SKETCH.given(symbol=what.symbol, axis=what.axis, way=way, reference=what.reference),
        alternative=Words("Sketch: {symbol} = {value}; +{axis} leans {way} +{reference}.").given(
            symbol=what.symbol, value=written, axis=what.axis, way=way, reference=what.reference
        ),
        x_title=same_in_all_languages(what.reference),
        y_title=same_in_all_languages(what.axis),
        x_unit=MILLIMETRE.symbol,
        y_unit=MILLIMETRE.symbol,
        panels=(
            Panel(
                curves=(
                    Curve(f"+{what.reference}", Role.MEAN_POSITIVE, ends * length, ends * 0.0),
                    Curve("90°", Role.BAND_LIMIT, ends * 0.0, ends * length),
                    Curve(f"+{what.axis}", Role.MEAN_NEGATIVE, -lean * ends * length, ends * length),
                )
            ),
        ),
    )


def _write_slope(value: float | None) -> Words:
    printed = MICROMETRE_PER_METRE.from_si(value or 0.0)
    return Words("{value} µm/m").given(value=float(f"{printed:.6g}"))


_PAIR = ("slope_1", "slope_2")
_TWO = Words("Two lines")
_POSITIONS = Words("At least {number} positions on each line")
_MEET = Words("Both lines in one plane (measurement.at)")
_APART = Words("{distance} apart in {axis}")
_NOT_STATED = Words("not stated")
_SQUARE_IS_STATED = Words("The angle of the square with its uncertainty (square)")
_NO_SUCH_SQUARE = Words(
    "90° + {error}″ = {angle}° is the angle of no square; square.error is its angle minus 90°"
)
_LEANS = {
    "C0Y": Words(
        "C0Y is the turn of +Y against +X, right-handed about +Z: above zero the angle between +X and +Y is "
        "larger than 90°."
    ),
    "B0Z": Words(
        "B0Z is the turn of +Z against +X, right-handed about +Y: above zero the angle between +X and +Z is "
        "smaller than 90°."
    ),
    "A0Z": Words(
        "A0Z is the turn of +Z against +Y, right-handed about +X: above zero the angle between +Y and +Z is "
        "larger than 90°."
    ),
}
_OF_PARALLELISM = Words(
    "The value is the slope of the first line minus that of the second: readings of both must be positive in "
    "the same direction."
)
_OF_THE_LINES = Words(
    "The angle is that between the reference lines of the means of all runs: another kind of line gives "
    "another value."
)
_POSITION = Words("Target position")
_DEVIATION = Words("Deviation")
_LINES = Words("{symbol}: mean deviations of both lines with the {line}")
_SEEN = Words(
    "Two graphs of deviation over position: {lines}. Slopes of the reference lines: {first} and {second}."
)
_SKETCH = Words("What the sign of {symbol} says: +{axis} leans {way} +{reference}, drawn far too large")
_AWAY, _TOWARDS = Words("away from"), Words("towards")
