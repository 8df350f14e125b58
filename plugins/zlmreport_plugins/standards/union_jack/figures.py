"""The graphs of a union jack: the plate as a wire picture, magnified upwards, and its plan with numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.plugin import (
    MICROMETRE,
    MILLIMETRE,
    Axis,
    Evaluation,
    Figure,
    FloatArray,
    Words,
    same_in_all_languages,
)
from zlmreport.plugin.standard import Curve, Note, Panel, Role, range_in_words
from zlmreport_plugins.standards.union_jack.heights import Plate, find_plate_of
from zlmreport_plugins.union_jack_lines import CENTRE_LINES, DIAGONALS, EDGES, LINES, PLACES

_SLOPE = math.radians(30)
#: Of the picture's height: that of the largest height of the plate.
_SHARE = 0.4
_KINDS = ((DIAGONALS, Role.CHANNEL_1), (EDGES, Role.CHANNEL_3), (CENTRE_LINES, Role.CHANNEL_2))
#: Notes of a plan that stand nearer than this share of a side hide each other.
_NEAR = 0.045


def draw_figures(evaluation: Evaluation) -> Iterator[Figure]:
    """Yield the wire picture and the plan, if all lines are there without a gap."""
    plate = find_plate_of(evaluation.statistics.tests)
    if plate is None or not np.isfinite(plate.heights).all():
        return
    axis = evaluation.measurements.axis
    above = {name: plate.profiles[name].heights - plate.heights.min() for name in LINES}
    largest = float(np.ptp(plate.heights))
    magnified = _choose_magnification(plate, largest)
    yield _make_figure(
        "plate",
        _WIRE,
        axis,
        plate,
        _draw_wire(plate, above, magnified),
        _MAGNIFIED.given(times=magnified, width=_name_side(plate, 0), depth=_name_side(plate, 1)),
    )
    yield _make_figure(
        "plan",
        _PLAN,
        axis,
        plate,
        _draw_plan(plate, above),
        _SIDES.given(width=_name_side(plate, 0), depth=_name_side(plate, 1)),
    )


def _make_figure(key: str, title: Words, axis: Axis, plate: Plate, panel: Panel, below: Words) -> Figure:  # noqa: PLR0913, PLR0917 - the parts of a figure
    heights, points = plate.heights - plate.heights.min(), plate.points
    low, high = int(heights.argmin()), int(heights.argmax())
    alternative = _SEEN.given(
        heights=range_in_words(axis, _HEIGHTS, heights) or _HEIGHTS,
        low=_place(points[low]),
        high=_place(points[high]),
    )
    return Figure(
        key=key,
        title=title,
        alternative=alternative,
        x_title=below,
        y_title=_HEIGHT,
        x_unit=MILLIMETRE.symbol,
        y_unit=axis.deviation_unit.symbol,
        panels=(panel,),
    )


def _draw_wire(plate: Plate, above: dict[str, FloatArray], magnified: float) -> Panel:
    """Return the plate seen from above its south-west corner, its lowest level as a frame below it."""
    ground = _project_places(_list_corners(plate), np.zeros(5), magnified)
    curves = [Curve("", Role.BAND_LIMIT, *ground)]
    for names, role in _KINDS:
        lines = [_project_places(plate.lay_stations(name), above[name], magnified) for name in names]
        curves.append(Curve(_write_notation(names), role, *_join_in_one(lines)))
    notes = []
    for name in LINES:
        places, heights = plate.lay_stations(name), above[name]
        x, y = _project_places(places, heights, magnified)
        for index in _choose_told(name, heights, above):
            notes.append(Note(float(x[index]), float(y[index]), _write_number(heights[index])))
            foot = _project_places(places[[index, index]], np.array([heights[index], 0.0]), magnified)
            curves.append(Curve("", Role.PATH, *foot))
    return Panel(curves=tuple(curves), notes=tuple(notes), projection="wire")


def _choose_told(name: str, heights: FloatArray, above: dict[str, FloatArray]) -> Iterator[int]:
    """Yield the stations whose heights the wire picture tells: corners, lowest and highest point, middles."""
    last = len(heights) - 1
    lowest = min(float(each.min()) for each in above.values())
    highest = max(float(each.max()) for each in above.values())
    found = {0, last} if name in DIAGONALS else set()
    if name in CENTRE_LINES:
        found |= {0, last}
    if name == DIAGONALS[0] and last % 2 == 0:
        found.add(last // 2)
    for extreme in (lowest, highest):
        owner = next(each for each in LINES if extreme in above[each])
        at = int(np.flatnonzero(above[owner] == extreme)[0])
        # A corner or a middle of an edge is told by the diagonals and centre lines already.
        if owner == name and not (name in EDGES and at in {0, last / 2, last}):
            found.add(at)
    yield from sorted(found)


def _draw_plan(plate: Plate, above: dict[str, FloatArray]) -> Panel:
    """Return the plate from above, north at the top, with the height of each station in micrometres."""
    curves, notes = [], list[Note]()
    written: list[FloatArray] = []
    sides = np.array(plate.sides)
    for names, role in _KINDS:
        lines = [_write_millimetres(plate.lay_stations(name)) for name in names]
        curves.append(
            Curve(_write_notation(names), role, *_join_in_one([(each[:, 0], each[:, 1]) for each in lines]))
        )
    for name in (*EDGES, *DIAGONALS, *CENTRE_LINES):
        for place, height in zip(plate.lay_stations(name), above[name], strict=True):
            # Where lines meet they tell the same height; where they come near, the first one is told.
            if any(np.abs((place - other) / sides).max() < _NEAR for other in written):
                continue
            written.append(place)
            east, north = _write_millimetres(place).tolist()
            notes.append(Note(east, north, _write_number(height)))
    for name in ("NW", "NE", "SE", "SW"):
        east, north = _write_millimetres(np.array(_find_corner(plate, name))).tolist()
        notes.append(Note(east, north, same_in_all_languages(name), is_below=True))
    return Panel(curves=tuple(curves), notes=tuple(notes), projection="wire")


def _find_corner(plate: Plate, name: str) -> tuple[float, float]:
    x, y = np.array(PLACES[name]) * plate.sides
    return float(x), float(y)


def _list_corners(plate: Plate) -> FloatArray:
    """Return the corners of the plate in turn, the first one again at the end, m, (5, 2)."""
    return np.array([_find_corner(plate, name) for name in ("SW", "SE", "NE", "NW", "SW")])


def _project_places(
    places: FloatArray, heights: FloatArray, magnified: float
) -> tuple[FloatArray, FloatArray]:
    """Return where places of a plate stand in the picture, mm: isometric, north to the upper left."""
    east, north = places[:, 0], places[:, 1]
    across = (east - north) * math.cos(_SLOPE)
    upwards = (east + north) * math.sin(_SLOPE) + magnified * heights
    return _write_millimetres(across), _write_millimetres(upwards)


def _write_millimetres(lengths: FloatArray) -> FloatArray:
    return np.asarray(MILLIMETRE.from_si(lengths))


def _join_in_one(lines: Sequence[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, FloatArray]:
    """Return lines as one curve with gaps between them."""
    gap = np.array([np.nan])
    x, y = (np.concatenate([part for line in lines for part in (line[axis], gap)]) for axis in (0, 1))
    return x, y


def _choose_magnification(plate: Plate, largest: float) -> float:
    """Return a round number of times by which heights are drawn larger than the plate."""
    if not largest:
        return 1.0
    wanted = _SHARE * sum(plate.sides) * math.sin(_SLOPE) / largest
    return float(f"{wanted:.1g}")


def _write_notation(names: Sequence[str]) -> str:
    return ", ".join(name.replace("-", "–") for name in names)


def _write_number(height: float) -> float:
    return float(MICROMETRE.from_si(height))


def _name_side(plate: Plate, axis: int) -> Words:
    return Words("{length} mm").given(length=float(f"{MILLIMETRE.from_si(plate.sides[axis]):.4g}"))


def _place(place: FloatArray) -> Words:
    east, north = (float(f"{MILLIMETRE.from_si(each):.4g}") for each in place)
    return _AT.given(east=east, north=north)


_HEIGHT = Words("Height")
_HEIGHTS = Words("Heights")
_WIRE = Words("The plate above its lowest point, drawn isometrically; heights in µm")
_PLAN = Words("Plan of the plate with the heights above its lowest point in µm, north at the top")
_MAGNIFIED = Words("From west to east {width}, from south to north {depth}; heights magnified {times} times")
_SIDES = Words("From west to east {width}, from south to north {depth}")
_AT = Words("{east} mm east, {north} mm north")
_SEEN = Words(
    "Picture of the plate: {heights} Lowest point {low}, highest point {high} of the south-west corner."
)
