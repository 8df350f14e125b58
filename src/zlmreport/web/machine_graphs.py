"""A test of a machine as the linked graphs of a page draw it: over the angle, and over each axis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from zlmreport.document.subjects.linked import collect_drawn_values
from zlmreport.language import Language, Words, same
from zlmreport.machines.comparison import ComparedTest
from zlmreport.machines.course import CircularTest, StraightTest
from zlmreport.machines.residual import Stretch, centre
from zlmreport.machines.subjects.tests import draw_circle, draw_line, write_title_of
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE
from zlmreport.model.effects.circle_design import AXES

#: Readings of a test that are drawn: more show nothing more.
_MOST = 3000
_TURN = 2.0 * np.pi


def collect_graph(found: ComparedTest, language: Language) -> dict[str, Any]:
    """Return a test as both graphs draw it, in µm: measured, by axes and effects, what is left."""
    sides = _Sides(found)
    drawn = sides.drawn
    figure = draw_circle(found) if sides.is_circle else draw_line(found)
    unit = MICROMETRE
    return {
        "test": found.name,
        "kind": "circle" if sides.is_circle else "line",
        "title": write_title_of(found.test).in_language(language),
        "axes": [_make_axis(*each, language) for each in sides.list_axes()],
        "arrows": ["↻", "↺"] if sides.is_circle else ["↓", "↑"],
        "unit": unit.symbol,
        "deviation": figure.y_title.in_language(language),
        "residual": _RESIDUAL.in_language(language),
        "readings": {
            "place": drawn.tolist(),
            "direction": sides.way[drawn].astype(int).tolist(),
            "run": sides.run[drawn].tolist(),
            "deviation": collect_drawn_values(unit.from_si(sides.reduce(found.test.deviation)[drawn])),
            "residual": collect_drawn_values(unit.from_si(sides.reduce(found.left)[drawn])),
            "fitted": [True] * len(drawn),
        },
        "model": collect_model(found),
        "noise": None,
        "alternative": figure.alternative.in_language(language),
    }


def collect_model(found: ComparedTest) -> list[dict[str, Any]]:
    """Return what axes and effects make of a test in each direction, with the band of the axes."""
    sides = _Sides(found)
    model = sides.reduce(found.test.deviation) - sides.reduce(found.left)
    u = found.prediction.expanded_uncertainty
    curves = []
    for way in (1, -1):
        own = np.flatnonzero(sides.way == way)
        if not len(own):
            continue
        own = own[sides.run[own] == sides.run[own].min()]
        own = own[np.argsort(sides.place[own])][:: max(1, len(own) // _MOST)]
        curves.append(
            {
                "direction": way,
                "x": collect_drawn_values(sides.place[own]),
                "y": collect_drawn_values(MICROMETRE.from_si(model[own])),
                "low": collect_drawn_values(MICROMETRE.from_si(model[own] - u[own])),
                "high": collect_drawn_values(MICROMETRE.from_si(model[own] + u[own])),
                "reach": False,
            }
        )
    return curves


def collect_residuals(found: ComparedTest) -> list[float | None]:
    """Return what is left at each reading that is drawn, µm."""
    sides = _Sides(found)
    return collect_drawn_values(MICROMETRE.from_si(sides.reduce(found.left)[sides.drawn]))


def find_readings_of(stretch: Stretch, found: ComparedTest) -> list[int]:
    """Return the drawn readings of a stretch, by their places."""
    sides = _Sides(found)
    test, drawn = found.test, sides.drawn
    at = test.angle % _TURN if isinstance(test, CircularTest) else test.at
    inside = (sides.way == stretch.sense) & (at >= stretch.begin) & (at <= stretch.end)
    return [int(each) for each in drawn[inside[drawn]]]


class _Sides:
    """What a circle and a line have alike: a direction, a place along the test, a run."""

    def __init__(self, found: ComparedTest) -> None:
        test = found.test
        self.test = test
        self.is_circle = isinstance(test, CircularTest)
        if isinstance(test, CircularTest):
            self.way: FloatArray = test.sense
            self.run: IntArray = test.run
            self.place: FloatArray = np.degrees(test.angle) % 360.0
            self.position: FloatArray = test.make_course().position
        else:
            self.way = test.direction
            self.run = np.ones(len(test.at), dtype=np.int64)
            self.place = MILLIMETRE.from_si(test.at)
            self.position = test.course.position

    @property
    def drawn(self) -> IntArray:
        """Which readings are drawn."""
        return np.arange(0, len(self.way), max(1, -(-len(self.way) // _MOST)))

    def reduce(self, values: FloatArray) -> FloatArray:
        """Return values as a page shows them: without centre and radius, or without the mean."""
        test = self.test
        return centre(test, values) if isinstance(test, CircularTest) else values - values.mean()

    def list_axes(self) -> Iterator[tuple[str, Words, str, FloatArray]]:
        """Yield all over which the readings can be laid out: key, title, unit, values."""
        drawn = self.drawn
        yield (
            "position",
            _ANGLE if self.is_circle else _PLACE,
            "°" if self.is_circle else "mm",
            self.place[drawn],
        )
        for index, axis in enumerate(AXES):
            if np.ptp(self.position[:, index]) > 0:
                places = MILLIMETRE.from_si(self.position[drawn, index])
                yield f"axis-{axis}", same(axis), "mm", places
        if isinstance(self.test, StraightTest):
            yield "direction", _DIRECTION, "", self.way[drawn]
            return
        yield "run", _RUN, "", self.run[drawn].astype(np.float64)
        yield "direction", _SENSE, "", self.way[drawn]


def _make_axis(key: str, title: Words, unit: str, values: FloatArray, language: Language) -> dict[str, Any]:
    return {
        "key": key,
        "title": title.in_language(language),
        "unit": unit,
        "values": collect_drawn_values(values),
    }


_ANGLE, _PLACE = Words("Angle"), Words("Place on the line")
_RUN, _SENSE = Words("Turn"), Words("Sense")
_DIRECTION, _RESIDUAL = Words("Direction"), Words("Residual")
