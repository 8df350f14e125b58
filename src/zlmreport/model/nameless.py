"""Nameless shapes, as any cause might have them, against which a named effect must hold its own.

An effect that merely resembles what is there loses to a smooth curve; only so can the answer be that no
known effect explains it. A nameless is a random curve of unknown size along position, time, run or direction:
its many coefficients are not fitted but averaged over, and so cost no more than the data make them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.model.contrasts import Contrasts, Metric
from zlmreport.model.design import Design
from zlmreport.model.noise import by_session
from zlmreport.quantities.arrays import FloatArray, IntArray

#: Variances that are tried of a shape, in units of σ²: from hidden in the scatter to far above it.
SIZES = (0.1, 0.5, 2.5, 12.0, 60.0, 600.0, 10_000.0)

#: Correlation lengths of smooth curves, as shares of the travel or the duration.
_LENGTHS = (0.3, 0.1)
_TERMS = 12
_LEAST_VARIANCE = 1e-7
_GRID = 120
_LEAST_VISIBLE = 1e-3


@dataclass(frozen=True, slots=True)
class NamelessShape:
    """A shape without a name."""

    shape: Words  #: In words.
    #: (N, f): Error contrasts whose random combination is the shape, of mean variance one.
    features: FloatArray


@dataclass(frozen=True, slots=True)
class ShapeModes:
    """The nameless shapes under one φ, turned so that their coefficients are independent."""

    turn: FloatArray  #: (nameless, f, f): From products with the features to products with the modes.
    strengths: FloatArray  #: (nameless, f): What the readings know of each mode.


def nameless_shapes(design: Design, space: Contrasts) -> tuple[NamelessShape, ...]:
    """Return the shapes that the plan can see beside the model; a smooth one once for each length."""
    along, moment = _unit(design.position), _unit(design.time)
    lever = (2.0 * along - 1.0)[:, np.newaxis]
    by_target, by_run = _membership(design.target), _membership(design.cycle)
    shapes = [(_IRREGULAR_PLACE, by_target), (_RUNS, by_run), (_SLOPE_RUNS, lever * by_run)]
    direction = design.direction[:, np.newaxis]
    if design.is_bidirectional:
        shapes.append((_IRREGULAR_DIRECTION, direction * by_target))
    for length in _LENGTHS:
        place, time = _smooth(along, length), by_session(design, _smooth(moment, length))
        shapes += [
            (_SMOOTH_PLACE, place),
            (_SMOOTH_TIME, time),
            (_SLOPE_TIME, lever * time),
            (_BOTH_TIME, np.concatenate([time, lever * time], axis=1)),
        ]
        if design.is_bidirectional:
            up = direction > 0
            shapes += [
                (_DIRECTION_PLACE, direction * place),
                (_UP_AND_DOWN, np.concatenate([up * place, ~up * place], axis=1)),
                (_DIRECTION_TIME, direction * time),
            ]
    found = []
    for words, features in shapes:
        contrasts = space.of(features)
        size = float(np.sqrt(np.mean(np.sum(contrasts**2, axis=1))))
        if size > _LEAST_VISIBLE * np.sqrt(np.mean(np.sum(features**2, axis=1))):
            found.append(NamelessShape(words, contrasts / size))
    return tuple(found)


@dataclass(frozen=True, slots=True)
class ShapeGroup:
    """The shapes of one number of features: padded to the widest, many targets would not fit in memory."""

    shapes: IntArray  #: (g,) integer: Their places among all shapes.
    places: IntArray  #: (g, f) integer: Of their features among the columns of all shapes side by side.
    gram: FloatArray  #: (g, f, f): Products of each shape's features among themselves.


def side_by_side(
    nameless: tuple[NamelessShape, ...], readings: int
) -> tuple[FloatArray, tuple[ShapeGroup, ...]]:
    """Return the features of all shapes as columns, and the shapes by their number of features."""
    columns = np.concatenate([np.empty((readings, 0)), *(each.features for each in nameless)], axis=1)
    widths = np.array([each.features.shape[1] for each in nameless], dtype=np.int64)
    first = np.cumsum(widths) - widths
    groups = []
    for width in np.unique(widths).tolist():
        shapes = np.flatnonzero(widths == width)
        places = first[shapes][:, np.newaxis] + np.arange(width)
        groups.append(
            ShapeGroup(shapes, places, np.stack([columns[:, row].T @ columns[:, row] for row in places]))
        )
    return columns, tuple(groups)


def modes(metric: Metric, shared: FloatArray, group: ShapeGroup) -> ShapeModes:
    """Return the independent modes of the shapes of a group under one φ.

    `shared`, (r, K): Products of the noise's factors and the features.
    """
    coordinates = metric.coordinates(shared)[:, group.places].transpose(1, 0, 2)
    strengths, vectors = np.linalg.eigh(group.gram - coordinates.transpose(0, 2, 1) @ coordinates)
    return ShapeModes(vectors.transpose(0, 2, 1), np.maximum(strengths, 0.0))


def _unit(values: FloatArray) -> FloatArray:
    extent = float(np.ptp(values))
    return np.asarray((values - values.min()) / (extent or 1.0), dtype=np.float64)


def _smooth(where: FloatArray, length: float) -> FloatArray:
    """Return the leading eigenfunctions of a smooth random curve on 0 to 1, at the readings."""
    grid = np.linspace(0.0, 1.0, _GRID)
    values, functions = np.linalg.eigh(np.exp(-0.5 * ((grid[:, np.newaxis] - grid) / length) ** 2))
    kept = np.flatnonzero(values > _LEAST_VARIANCE * values[-1])[-_TERMS:]
    terms = functions[:, kept] * np.sqrt(values[kept])
    return np.column_stack([np.interp(where, grid, term) for term in terms.T])


def _membership(labels: IntArray) -> FloatArray:
    return np.asarray(labels[:, np.newaxis] == np.unique(labels), dtype=np.float64)


_SMOOTH_PLACE = Words(en="smooth along the axis", de="glatt über der Achse")
_DIRECTION_PLACE = Words(
    en="a reversal value that changes smoothly along the axis",
    de="eine Umkehrspanne, die sich glatt über der Achse ändert",
)
_UP_AND_DOWN = Words(
    en="smooth along the axis, up and down each in its own way",
    de="glatt über der Achse, aufwärts und abwärts verschieden",
)
_SMOOTH_TIME = Words(
    en="smooth in time, alike at all positions", de="glatt in der Zeit, an allen Positionen gleich"
)
_SLOPE_TIME = Words(
    en="a slope along the axis that changes smoothly in time",
    de="eine Steigung über der Achse, die sich glatt mit der Zeit ändert",
)
_BOTH_TIME = Words(
    en="zero and slope along the axis change smoothly in time",
    de="Nullpunkt und Steigung über der Achse ändern sich glatt mit der Zeit",
)
_DIRECTION_TIME = Words(
    en="a reversal value that changes smoothly in time",
    de="eine Umkehrspanne, die sich glatt mit der Zeit ändert",
)
_RUNS = Words(en="every run displaced as a whole", de="jeder Durchlauf als Ganzes verschoben")
_SLOPE_RUNS = Words(
    en="a slope along the axis that differs from run to run",
    de="eine Steigung über der Achse, die von Durchlauf zu Durchlauf wechselt",
)
_IRREGULAR_PLACE = Words(
    en="irregular from position to position, alike in all runs",
    de="unregelmäßig von Position zu Position, in allen Durchläufen gleich",
)
_IRREGULAR_DIRECTION = Words(
    en="irregular from position to position, opposite up and down",
    de="unregelmäßig von Position zu Position, aufwärts und abwärts entgegengesetzt",
)
