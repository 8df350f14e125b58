"""The sequence of a planned test: where the axis stands, reading by reading, and where it turns round."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from zlmreport.document.figures.figure import Curve, Figure, Panel, PlottedReadings, Role
from zlmreport.document.figures.prescribed import alternative_text
from zlmreport.evaluation.checks import position_in_words, positions_in_words, readings_in_words
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.model.planning.programs import Motion, ProgramStop

_TITLE = Words(
    "Position of the axis over its readings, in the order in which they are taken; ↑ and ↓ are the "
    "directions in which it comes to a target"
)
_SENTENCE = Words("{readings}, {runs} at each of {positions} from {first} to {last}.")
_TURNS = Words("The axis turns round {overrun} beyond.")
_X_TITLE = Words("Number of the reading")
_Y_TITLE = Words("Position")


def draw_sequence(motion: Motion) -> Figure:
    """Return the graph of a planned test's sequence: position over the number of the reading."""
    places = list(_place_stops(motion.stops))
    path = Curve(
        "",
        Role.PATH,
        read_only_floats(places),
        read_only_floats([stop.position for stop in motion.stops]),
    )
    return Figure(
        key="sequence",
        title=_TITLE,
        alternative=_describe_in_words(motion),
        x_title=_X_TITLE,
        y_title=_Y_TITLE,
        x_unit="",
        y_unit=motion.axis.position_unit.symbol,
        panels=(Panel(curves=(path,), readings=tuple(_mark_readings(motion))),),
    )


def _place_stops(stops: Sequence[ProgramStop]) -> Iterator[float]:
    """Yield where each stop stands: a reading at its number, turning points evenly between."""
    number = 0
    for is_read, group in groupby(stops, key=lambda stop: stop.reading is not None):
        some = list(group)
        if is_read:
            yield from (float(number + count) for count in range(1, len(some) + 1))
            number += len(some)
        else:
            yield from (number + part for part in np.linspace(0, 1, len(some) + 2)[1:-1].tolist())


def _mark_readings(motion: Motion) -> Iterator[PlottedReadings]:
    for approach in Approach:
        found = [
            (stop.reading.number, stop.position)
            for stop in motion.stops
            if stop.reading is not None and stop.reading.approach is approach
        ]
        if found:
            numbers, positions = np.array(found).T
            yield PlottedReadings(approach, read_only_floats(numbers), read_only_floats(positions))


def _describe_in_words(motion: Motion) -> Words:
    to_si = motion.axis.position_unit.to_si
    readings = sum(stop.reading is not None for stop in motion.stops)
    return alternative_text(
        _SENTENCE.given(
            readings=readings_in_words(readings),
            runs=readings // len(motion.targets),
            positions=positions_in_words(len(motion.targets)),
            first=position_in_words(motion.axis, to_si(motion.targets[0])),
            last=position_in_words(motion.axis, to_si(motion.targets[-1])),
        ),
        _TURNS.given(overrun=position_in_words(motion.axis, to_si(motion.overrun))),
    )
