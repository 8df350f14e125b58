"""Whether circles run again, with tables across axes loaded, show what the tables promised.

What changed between two circles is held against what the tables take away of them: a least-squares part of 1
says that they act as they should, −1 that their sign is wrong, 0 that they are not in effect. The centre of
each turn and the radius may change by themselves. The part has an uncertainty by the noise that the
difference itself shows, along the path and over the angle.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.machines.course import CircularTest
from zlmreport.machines.cross_making import CrossMade
from zlmreport.machines.cross_tables import compensate_machine
from zlmreport.machines.design import ThinnedDesign, clear_of_reversals, make_thinned_design
from zlmreport.machines.machine import MachineModel, predict
from zlmreport.machines.measured_tests import MeasuredCircle, read_tests
from zlmreport.machines.noise import CircleNoise, NoiseModel, find_noise
from zlmreport.machines.reading import MachineFile
from zlmreport.machines.residual import centre, compute_root_mean_square
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.compensation.curve import CrossTable
from zlmreport.plugin.registry import Registry

#: A part of the tables is taken for 1, ½, 0 or −1 within this, or within its own uncertainty.
_NEAR = 0.2
#: A part that is known no better says nothing.
_UNKNOWN = 0.5
#: Arcs over which both circles are averaged, a turn.
_ARCS = 180
_SAME = 1e-6


class CrossVerdict(StrEnum):
    """What became of tables across axes."""

    HELD = "held"
    WRONG_SIGN = "wrong-sign"
    HALF = "half"
    NOT_IN_EFFECT = "not-in-effect"
    OTHER = "other"
    NOT_SEEN = "not-seen"


@dataclass(frozen=True, slots=True)
class ConfirmedCircle:
    """A circle before and after: root mean squares about the centre, m."""

    name: str  #: Of the later test.
    before: float
    forecast: float
    after: float


@dataclass(frozen=True, slots=True)
class CrossConfirmation:
    """How later circles stand to the forecast."""

    verdict: CrossVerdict
    applied: float  #: What part of the tables the circles show to be in effect.
    expanded_uncertainty: float  #: Of that part, k = 2.
    circles: tuple[ConfirmedCircle, ...]


def confirm(
    machine: MachineFile, made: CrossMade, jobs: Sequence[Path], registry: Registry, place: Place
) -> CrossConfirmation:
    """Hold the circles of jobs, run with tables in effect, against those of a machine file.

    Raises `InputError` if a job is no circle, or none that was run before.
    """
    after = []
    for path in jobs:
        (test, *_), _ = read_tests(path, registry)
        if not isinstance(test, MeasuredCircle):
            raise InputError.at(place, f"{path.name} is no circle; tables are confirmed by circles run again")
        after.append(test.circle)
    return confirm_circles(machine.machine, made.decoded, machine.circles, after, place)


def confirm_circles(
    machine: MachineModel,
    tables: Sequence[CrossTable],
    before: Sequence[CircularTest],
    after: Sequence[CircularTest],
    place: Place,
) -> CrossConfirmation:
    """Hold circles with tables in effect against those without.

    Raises `InputError` at `place` if one of them was not run before: same plane, centre, radius and feed.
    """
    pairs = [(_find_like(each, before, place), each) for each in after]
    corrected = compensate_machine(machine, tables)
    changes = [_change(one, other) for one, other in pairs]
    taken = [_compute_taken(machine, corrected, each) for each in changes]
    part, u = _fit_part(changes, taken)
    circles = []
    for one, other in pairs:
        expected = one.deviation - _compute_taken(machine, corrected, one)
        sizes = ((one, one.deviation), (one, expected), (other, other.deviation))
        was, forecast, now = (compute_root_mean_square(centre(circle, values)) for circle, values in sizes)
        circles.append(ConfirmedCircle(other.name, was, forecast, now))
    return CrossConfirmation(_decide_verdict(part, u), part, u, tuple(circles))


def _decide_verdict(part: float, u: float) -> CrossVerdict:
    if not u < _UNKNOWN:
        return CrossVerdict.NOT_SEEN
    named = {
        1.0: CrossVerdict.HELD, -1.0: CrossVerdict.WRONG_SIGN, 0.0: CrossVerdict.NOT_IN_EFFECT,
        0.5: CrossVerdict.HALF,
    }  # fmt: skip
    nearest = min(named, key=lambda each: abs(part - each))
    return named[nearest] if abs(part - nearest) <= max(_NEAR, u) else CrossVerdict.OTHER


def _find_like(circle: CircularTest, before: Sequence[CircularTest], place: Place) -> CircularTest:
    """Return the circle of before that was run on the same path."""
    own = circle.nominal
    for each in before:
        other = each.nominal
        numbers = zip(
            (own.radius, own.feed, *own.centre), (other.radius, other.feed, *other.centre), strict=True
        )
        if own.plane == other.plane and all(abs(one - two) < _SAME for one, two in numbers):
            return each
    known = ", ".join(each.name for each in before) or "none"
    raise InputError.at(
        place,
        f"{circle.name} was run on no path of a circle before (plane, centre, radius, feed); of the machine "
        f"file there are: {known}",
    )


def _change(before: CircularTest, after: CircularTest) -> CircularTest:
    """Return a circle of which the deviation is what went: mean before minus mean after, over arcs."""
    angle, sense, went = [], [], []
    for way in (1.0, -1.0):
        (count, was), (now_count, now) = (_compute_means(each, way) for each in (before, after))
        both = np.flatnonzero((count > 0) & (now_count > 0))
        places = (both + 0.5) * 2.0 * np.pi / _ARCS
        order = np.argsort(way * places, kind="stable")
        angle.append(places[order])
        sense.append(np.full(len(both), way))
        went.append((was - now)[both][order])
    angles = np.concatenate(angle)
    return replace(
        after,
        angle=angles,
        sense=np.concatenate(sense),
        run=np.ones(len(angles), dtype=np.int64),
        deviation=np.concatenate(went),
        time=np.arange(len(angles), dtype=np.float64),
    )


def _compute_means(circle: CircularTest, way: float) -> tuple[FloatArray, FloatArray]:
    """Return number and mean of the readings of one sense in each arc of a turn."""
    kept = clear_of_reversals(circle)
    own = kept.sense == way
    where = np.floor((kept.angle[own] % (2.0 * np.pi)) / (2.0 * np.pi) * _ARCS).astype(int) % _ARCS
    count = np.bincount(where, minlength=_ARCS).astype(np.float64)
    return count, np.bincount(where, kept.deviation[own], _ARCS) / np.maximum(count, 1.0)


def _compute_taken(machine: MachineModel, corrected: MachineModel, circle: CircularTest) -> FloatArray:
    """Return what tables take away of a circle, (N,), m."""
    course = circle.make_course()
    return np.asarray(predict(machine, course).values - predict(corrected, course).values)


def _fit_part(changes: Sequence[CircularTest], taken: Sequence[FloatArray]) -> tuple[float, float]:
    """Return what part of the tables went, and its U; U is infinite where the circles do not see them."""
    design = make_thinned_design(changes)
    column = design.thin(np.concatenate(taken))
    went = design.thin(np.concatenate([each.deviation for each in changes]))
    beside = np.column_stack(list(_list_free(design)))
    left = column - beside @ np.linalg.lstsq(beside, column, rcond=None)[0]
    if np.sum(left**2) <= 1e-6 * np.sum(column**2) or not np.any(column):
        return 0.0, float("inf")
    model = NoiseModel(CircleNoise(design), np.column_stack([column, beside]), np.zeros((design.count, 0)))
    noise = find_noise(model, went)
    solved = [model.solve(shape, went) for shape in noise.shapes]
    values = np.array([float(each[0]) for each, _ in solved])
    variances = noise.sigma**2 * np.array([float(each[0, 0]) for _, each in solved])
    part = float(noise.weights @ values)
    return part, 2.0 * float(np.sqrt(noise.weights @ (variances + (values - part) ** 2)))


def _list_free(design: ThinnedDesign) -> Iterator[FloatArray]:
    """Yield what may change by itself: the centre of each turn, the radius of each test."""
    for turn in design.turns.tolist():
        for wave in (np.cos(design.angle), np.sin(design.angle)):
            yield np.where(design.turn == turn, wave, 0.0)
    for test in np.unique(design.test).tolist():
        yield (design.test == test).astype(np.float64)
