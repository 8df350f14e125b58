"""Axes of graphs: limits, round ticks, which targets are labelled; numbers only, no drawing."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.language.formatting import DecimalSign, write_fixed_number
from zlmreport.measurement.arrays import FloatArray, count_decimals_of

#: Spans below this part of the largest value are rounding errors of the double and no span.
_RESOLUTION = 1e-10
_MOST_LABELLED_TARGETS = 16
_MOST_MARKED_TARGETS = 100
#: Of a position that is written whole.
_MOST_DECIMALS = 4
#: Least distance between two labels, and between two round positions, in points.
_LABEL_DISTANCE = 6.0
_LEAST_ROUND_DISTANCE = 34.0
#: Steps from angle to angle that divide a right angle, degrees.
_PARTS_OF_A_TURN = (15.0, 30.0, 45.0, 90.0)
#: Of an axis of deviations, and where three or more would touch: one number alone gives no scale.
_FEWEST_TICKS, _FEWEST_WITHOUT_ROOM = 3, 2
#: How many times as many ticks as fit well still have room for their numbers.
_CROWDED = 2
#: More steps that are tried of positions where fewer leave a single label, which shows no length.
_MORE_STEPS = 2


@dataclass(frozen=True, slots=True)
class AxisScale:
    """One axis."""

    #: lower and upper: Its ends.
    lower: float
    upper: float
    ticks: tuple[float, ...]  #: Values with a label, rising.
    labels: tuple[str, ...]  #: What is written at them; of several lines where there is a line break.
    marks: tuple[float, ...] = ()  #: Values with a small tick and no label.


def find_extremes(values: FloatArray) -> tuple[float, float]:
    """Return the least and the greatest finite value; (0, 0) where there is none."""
    finite = values[np.isfinite(values)]
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)


def widen(lower: float, upper: float, part: float) -> tuple[float, float]:
    """Return the limits moved outwards by a part of their span; equal limits get a span of their own."""
    span = upper - lower
    greatest = max(abs(lower), abs(upper))
    if span <= greatest * _RESOLUTION:
        half = greatest / 20 or 1.0
        return lower - half, upper + half
    return lower - part * span, upper + part * span


def include_zero(lower: float, upper: float) -> tuple[float, float]:
    """Return the limits with zero inside, if that costs no more than half of their span."""
    span = upper - lower
    if 0 < lower <= span / 2:
        return 0.0, upper
    if -span / 2 <= upper < 0:
        return lower, 0.0
    return lower, upper


def round_ticks(lower: float, upper: float, most: int) -> tuple[tuple[float, ...], int]:
    """Return multiples of 1, 2 or 5 · 10ⁿ between the limits, at most `most` steps, and their decimals."""
    least_step = (upper - lower) / most
    power = math.floor(math.log10(least_step))
    digit = next(digit for digit in (1, 2, 5, 10) if digit * 10.0**power >= least_step * (1 - 1e-9))
    if digit == 10:
        digit, power = 1, power + 1
    # Multiples of an integer, divided once: 0.3 and not 0.30000000000000004.
    factor = 10.0**-power
    first = math.ceil(lower * factor / digit - 1e-9)
    last = math.floor(upper * factor / digit + 1e-9)
    return tuple(number * digit / factor for number in range(first, last + 1)), max(0, -power)


def make_value_scales(
    panels: Sequence[FloatArray], part: float, most: int, sign: DecimalSign, *, alike: bool = True
) -> tuple[AxisScale, ...]:
    """Return the axes of deviations, one for each panel, each about its own values.

    Beyond the outermost values a part of the span is left free.

    `part`: Of the span, left free at both ends.
    `most`: Largest number of ticks; of a flat graph more, so that there are three, or two without room.
    """
    limits = [include_zero(*find_extremes(values)) for values in panels]
    longest = max((upper - lower for lower, upper in limits), default=0.0)
    scales = []
    for own_lower, own_upper in limits:
        span = longest if alike else own_upper - own_lower
        middle = (own_lower + own_upper) / 2
        lower, upper = widen(middle - span / 2, middle + span / 2, part)
        scales.append(
            AxisScale(lower, upper, *_label_ticks(lower, upper, _count_steps(lower, upper, most), sign))
        )
    return tuple(scales)


def _count_steps(lower: float, upper: float, most: int) -> int:
    """Return into how many steps an axis of deviations is parted at most."""

    def find_steps(fewest: int) -> tuple[int, int]:
        tried = ((steps, len(round_ticks(lower, upper, steps)[0])) for steps in itertools.count(most))
        return next((steps, ticks) for steps, ticks in tried if ticks >= fewest)

    steps, ticks = find_steps(_FEWEST_TICKS)
    return steps if ticks <= max(_FEWEST_TICKS, _CROWDED * most) else find_steps(_FEWEST_WITHOUT_ROOM)[0]


def make_position_scale(  # noqa: PLR0913 - what an axis follows from
    targets: FloatArray,
    width: float,
    room: float,
    sign: DecimalSign,
    width_of: Callable[[str], float],
    *,
    of_a_turn: bool = False,
) -> AxisScale:
    """Return the axis of positions.

    Labels stand at the targets where they fit and are written whole, else at round positions, and small
    ticks at the targets.

    `of_a_turn`: Whether positions are degrees of a turn, or of a good part of one: right angles are round.

    `targets`: Positions at which something is drawn, in any order.
    `width`: Of the axis, in points.
    `room`: Between the outermost targets and the ends of the axis, in points.
    `width_of`: Returns the width of a label in points.
    """
    positions = tuple(np.unique(targets[np.isfinite(targets)]).tolist())
    lower, upper = widen(*find_extremes(targets), room / (width - 2 * room))

    def fit(ticks: Sequence[float], labels: Sequence[str]) -> bool:
        places = [(tick - lower) / (upper - lower) * width for tick in ticks]
        return _keep_apart(places, [width_of(label) for label in labels])

    if len(positions) <= _MOST_LABELLED_TARGETS:
        decimals = count_decimals_of(np.array(positions), _MOST_DECIMALS)
        labels = tuple(write_fixed_number(position, decimals, sign) for position in positions)
        whole = np.allclose(positions, np.round(positions, decimals), rtol=1e-9, atol=1e-9)
        if positions and whole and fit(positions, labels):
            return AxisScale(lower, upper, positions, labels)
    most = int(width / _LEAST_ROUND_DISTANCE)
    marks = positions if len(positions) <= _MOST_MARKED_TARGETS else ()
    for step in _PARTS_OF_A_TURN if of_a_turn else ():
        ticks = tuple(step * n for n in range(math.ceil(lower / step), math.floor(upper / step) + 1))
        labels = tuple(write_fixed_number(tick, 0, sign) for tick in ticks)
        if 1 < len(ticks) <= most and fit(ticks, labels):
            return AxisScale(lower, upper, ticks, labels, marks)
    tried = [
        _label_ticks(lower, upper, steps, sign)
        for steps in (*range(most, 0, -1), *range(most + 1, most + 1 + _MORE_STEPS))
    ]
    fitting = [each for each in tried if fit(*each)]
    ticks, labels = next((each for each in fitting if len(each[0]) > 1), (fitting or tried)[0])
    return AxisScale(lower, upper, ticks, labels, marks)


def make_category_scale(names: Sequence[str], width: float, width_of: Callable[[str], float]) -> AxisScale:
    """Return the axis of things that stand side by side, the first at 0, the next at 1.

    Names that do not fit are parted into two lines at a hyphen; where even that is too long for one of them,
    all have numbers instead.

    `width`: Of the axis, in points.
    `width_of`: Returns the width of a label in points.
    """
    number = len(names)
    room = width / max(1, number) - _LABEL_DISTANCE
    labels = [name if width_of(name) <= room else _break_in_two(name) for name in names]
    if any(width_of(line) > room for label in labels for line in label.split("\n")):
        labels = [str(index) for index in range(number)]
    return AxisScale(-0.5, max(number, 1) - 0.5, tuple(map(float, range(number))), tuple(labels))


def _break_in_two(name: str) -> str:
    """Return a name parted after the hyphen or blank that is nearest to its middle."""
    places = [index + 1 for index, character in enumerate(name) if character in "- "]
    if not places:
        return name
    place = min(places, key=lambda index: abs(2 * index - len(name)))
    return f"{name[:place].rstrip()}\n{name[place:]}"


def _label_ticks(
    lower: float, upper: float, most: int, sign: DecimalSign
) -> tuple[tuple[float, ...], tuple[str, ...]]:
    ticks, decimals = round_ticks(lower, upper, most)
    return ticks, tuple(write_fixed_number(tick, decimals, sign) for tick in ticks)


def _keep_apart(places: Sequence[float], widths: Sequence[float]) -> bool:
    gaps = (
        (right - right_width / 2) - (left + left_width / 2)
        for (left, left_width), (right, right_width) in itertools.pairwise(zip(places, widths, strict=True))
    )
    return all(gap >= _LABEL_DISTANCE for gap in gaps)
