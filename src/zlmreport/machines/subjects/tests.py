"""Tests of a machine beside their prediction: tables of sizes and numbers, graphs of circles and lines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from zlmreport.document.blocks import Block, Cell, Column, Graph, Notice, Paragraph, Section, Symbol, Table
from zlmreport.document.figures.figure import Band, Curve, Figure, Panel, Role
from zlmreport.language import Words, named
from zlmreport.machines.comparison import ComparedTest, StandardNumbers
from zlmreport.machines.course import CircularTest, StraightTest
from zlmreport.machines.residual import Stretch, centre
from zlmreport.machines.subjects.saying import Sayer, make_plain_table, make_right_column
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE

_MOST_STRETCHES, _MOST_SHARES = 3, 5
_FEED = 60e3  # mm/min of one m/s
_ROLES = {1: (Role.MEAN_POSITIVE, Role.MODEL_POSITIVE), -1: (Role.MEAN_NEGATIVE, Role.MODEL_NEGATIVE)}
_BANDS = {1: Role.UNCERTAINTY_POSITIVE, -1: Role.UNCERTAINTY_NEGATIVE}
_ARROWS, _WAYS = {1: "↺", -1: "↻"}, {1: "↑", -1: "↓"}


def lay_out_sizes(
    tests: Sequence[ComparedTest], say: Sayer, noise: float | None = None, *, with_numbers: bool = False
) -> Table:
    """Return the root mean squares of all tests; with G of both senses, if it is asked for and there."""
    rows: list[tuple[Cell, ...]] = []
    for each in tests:
        sizes = (each.rms.measured, each.rms.predicted, each.rms.left)
        row: tuple[Cell, ...] = (each.name, *map(say.write_micrometres, sizes))
        if noise is not None:
            row = (*row, say.write_micrometres(noise))
        if with_numbers:
            row = (*row, *_write_both_senses(each.numbers, say))
        rows.append(row)
    headings = [_MEASURED, _PREDICTED, _LEFT, *([_NOISE] if noise is not None else [])]
    columns = [Column(say(_TEST)), *(make_right_column(say(each), "µm") for each in headings)]
    if with_numbers:
        columns += [make_right_column(f"G(b), {say(each)}", "µm") for each in (_MEASURED, _LEFT)]
    return make_plain_table(say(_SIZES), columns, rows)


def _write_both_senses(numbers: Iterable[StandardNumbers], say: Sayer) -> tuple[str, str]:
    for each in numbers:
        for parameter in each.measured:
            if parameter.quantity.symbol == "G_b":
                return say.write_micrometres(parameter.value), say.write_micrometres(each.left["G_b"])
    return "", ""


def lay_out_test(found: ComparedTest, say: Sayer) -> Section:
    """Return one test: what it is, sizes and numbers, what explains it, where it fails, its curves."""
    title = say(named(found.name, write_title_of(found.test)))
    return Section(f"test-{found.name}", title, tuple(_lay_out_test_blocks(found, say)))


def _lay_out_test_blocks(found: ComparedTest, say: Sayer) -> Iterator[Block]:
    yield lay_out_numbers(found, say)
    of_effects = [(say(effect.title), size) for effect, size in found.of_effects]
    for words, shares in ((_OF_AXES, found.of_axes.items()), (_OF_EFFECTS, of_effects)):
        listed = _list_shares(shares, say)
        if listed:
            yield Paragraph(say(words.given(shares=listed)))
    outside = float(np.mean(found.prediction.outside))
    if outside:
        yield Notice(say(_OUTSIDE_TITLE), (say(_OUTSIDE.given(share=max(round(100 * outside), 1))),))
    notice = make_failure_notice([found], say)
    if notice:
        yield notice
    yield Graph(draw_circle(found) if isinstance(found.test, CircularTest) else draw_line(found))


def lay_out_numbers(found: ComparedTest, say: Sayer) -> Table:
    """Return a test's root mean square and the numbers of its standards: measured, predicted, left."""
    sizes = (found.rms.measured, found.rms.predicted, found.rms.left)
    rows: list[tuple[Cell, ...]] = [("RMS", *map(say.write_micrometres, sizes))]
    for each in found.numbers:
        for parameter in each.measured:
            symbol = parameter.quantity.symbol
            values = (each.predicted.get(symbol, np.nan), each.left.get(symbol, np.nan))
            rows.append(
                (
                    Symbol(parameter.quantity.notation),
                    say.write_micrometres(parameter.value),
                    *(say.write_micrometres(value) if np.isfinite(value) else "" for value in values),
                )
            )
    columns = [Column(""), *(make_right_column(say(each), "µm") for each in (_MEASURED, _PREDICTED, _LEFT))]
    return make_plain_table(say(_NUMBERS.given(test=found.name)), columns, rows)


def write_title_of(test: CircularTest | StraightTest) -> Words:
    """Return what kind of test it is, with its place."""
    if isinstance(test, StraightTest):
        return _LINE.given(count=len(test.at))
    nominal = test.nominal
    return _CIRCLE.given(
        plane=nominal.plane,
        radius=float(f"{MILLIMETRE.from_si(nominal.radius):.6g}"),
        feed=float(f"{nominal.feed * _FEED:.6g}"),
    )


def _list_shares(shares: Iterable[tuple[str, float]], say: Sayer) -> str:
    largest = sorted(shares, key=lambda item: -item[1])[:_MOST_SHARES]
    return ", ".join(f"{name} {say.write_micrometres(size)}" for name, size in largest)


def make_failure_notice(tests: Sequence[ComparedTest], say: Sayer) -> Notice | None:
    """Return where tests differ from their prediction; None where none does."""
    items = tuple(
        say(_say_of_test(each, stretch, is_one=len(tests) == 1))
        for each in tests
        for stretch in each.fails[:_MOST_STRETCHES]
    )
    return Notice(say(Words("Where it differs from the prediction")), items) if items else None


def _say_of_test(found: ComparedTest, stretch: Stretch, *, is_one: bool) -> Words:
    said = describe_stretch(stretch, is_circle=isinstance(found.test, CircularTest))
    return said if is_one else named(found.name, said)


def describe_stretch(stretch: Stretch, *, is_circle: bool) -> Words:
    """Return where a residual leaves its band, and by how much it is off there."""
    places = ", ".join(
        f"{axis} {_write_millimetres(low)}–{_write_millimetres(high)}"
        for axis, (low, high) in stretch.coordinates.items()
    )
    size = float(f"{MICROMETRE.from_si(stretch.largest):.2g}")
    if not is_circle:
        way = _WAYS.get(int(stretch.sense), "")
        return Words("{way} {places} mm: {size} µm").given(places=places, way=way, size=size)
    return Words("{sense} from {begin}° to {end}° ({places} mm): {size} µm").given(
        sense=_SENSES[int(stretch.sense)],
        begin=round(float(np.degrees(stretch.begin))),
        end=round(float(np.degrees(stretch.end))),
        places=places,
        size=size,
    )


def _write_millimetres(value: float) -> str:
    return str(round(MILLIMETRE.from_si(value))).replace("-", "−")


def draw_circle(found: ComparedTest) -> Figure:
    """Return a circle: measured and predicted, and beside it what is left, both senses."""
    circle = found.test
    assert isinstance(circle, CircularTest)  # noqa: S101 - who asks has looked
    measured, predicted, left = (
        MICROMETRE.from_si(centre(circle, each))
        for each in (circle.deviation, found.prediction.values, found.left)
    )
    shown: list[Curve] = []
    rest: list[Curve] = []
    for way, (role, of_prediction) in _ROLES.items():
        own = np.flatnonzero(circle.sense == way)
        if not len(own):
            continue
        first = own[circle.run[own] == circle.run[own].min()]
        angle = np.degrees(circle.angle[first]) % 360.0
        arrow = _ARROWS[way]
        shown += [
            Curve(arrow, role, angle, measured[first]),
            Curve(f"{arrow} ∑", of_prediction, angle, predicted[first]),
        ]
        rest.append(Curve(arrow, role, angle, left[first]))
    directions = tuple(
        (turn, f"{sign}{axis}")
        for turn, sign, axis in (
            (0.0, "+", circle.nominal.axes[0]), (90.0, "+", circle.nominal.axes[1]),
            (180.0, "−", circle.nominal.axes[0]), (270.0, "−", circle.nominal.axes[1]),
        )
    )  # fmt: skip
    return Figure(
        f"circle-{found.name}",
        _CIRCLE_TITLE.given(test=found.name, what=write_title_of(circle)),
        _say_spans(measured, predicted, left), _ANGLE, _RADIAL, "°", "µm",
        (
            Panel(
                heading=_BOTH, curves=tuple(shown), projection="polar", directions=directions,
            ),
            Panel(heading=_WHAT_IS_LEFT, curves=tuple(rest), projection="polar", directions=directions),
        ),
        spans_are_alike=False, is_wide=True,
    )  # fmt: skip


def _say_spans(*curves: FloatArray) -> Words:
    """Say how far each curve goes, µm: measured, predicted, left."""
    spans = (float(f"{np.ptp(each):.3g}") for each in curves)
    return _CIRCLE_SEEN.given(**dict(zip(("measured", "predicted", "left"), spans, strict=True)))


def draw_line(found: ComparedTest) -> Figure:
    """Return a line: measured, and predicted with its band; below it what is left."""
    line = found.test
    assert isinstance(line, StraightTest)  # noqa: S101 - who asks has looked
    direction = line.direction
    shown: list[Curve] = []
    bands: list[Band] = []
    rest: list[Curve] = []
    measured, predicted, left = (
        MICROMETRE.from_si(each - each.mean())
        for each in (line.deviation, found.prediction.values, found.left)
    )
    u = MICROMETRE.from_si(found.prediction.expanded_uncertainty)
    for way, (role, of_prediction) in _ROLES.items():
        own = np.flatnonzero(direction == way)
        if not len(own):
            continue
        own = own[np.argsort(line.at[own])]
        at = MILLIMETRE.from_si(line.at[own])
        shown += [
            Curve(_WAYS[way], role, at, measured[own]),
            Curve(f"{_WAYS[way]} ∑", of_prediction, at, predicted[own]),
        ]
        bands.append(Band("U", _BANDS[way], at, predicted[own] - u[own], predicted[own] + u[own]))
        rest.append(Curve(_WAYS[way], role, at, left[own]))
    return Figure(
        f"line-{found.name}",
        _CIRCLE_TITLE.given(test=found.name, what=write_title_of(line)),
        _say_spans(measured, predicted, left), _PLACE, _DEVIATION, "mm", "µm",
        (
            Panel(heading=_BOTH, curves=tuple(shown), bands=tuple(bands)),
            Panel(heading=_WHAT_IS_LEFT, curves=tuple(rest)),
        ),
    )  # fmt: skip


_SIZES = Words("Root mean square of the tests: measured, predicted by the axes, and what is left")
_TEST = Words("Test")
_MEASURED, _PREDICTED = Words("measured"), Words("predicted")
_LEFT, _NOISE = Words("left"), Words("noise")
_NUMBERS = Words("{test}, measured and predicted")
_LINE = Words("line of {count} points")
_CIRCLE = Words("circle {plane}, R {radius} mm, {feed} mm/min")
_OF_AXES = Words("Of the prediction, root mean square: {shares} µm.")
_OF_EFFECTS = Words("Of the effects, root mean square: {shares} µm.")
_OUTSIDE_TITLE = Words("Outside of what was measured")
_OUTSIDE = Words(
    "{share} % of it lies beyond what was measured of the axes; the end values stand there, and nothing "
    "is extrapolated"
)
_SENSES = {1: Words("counter-clockwise", context="adverb"), -1: Words("clockwise", context="adverb")}
_CIRCLE_TITLE = Words("{test}: {what}; dashed, with ∑: what the axes predict")
_CIRCLE_SEEN = Words("Range measured {measured} µm, predicted {predicted} µm, left {left} µm.")
_ANGLE, _RADIAL = Words("Angle"), Words("Radial deviation")
_PLACE, _DEVIATION = (Words("Place on the line"), Words("Deviation"))
_BOTH = Words("measured and predicted")
_WHAT_IS_LEFT = Words("left")
