"""The next run of a ballbar: which circle decides between effects, in how many minutes, how likely.

Of two effects A and B, let the circles show A as it was estimated. With one run more, the part of A's curve
that B cannot imitate has the squared length κ in units of the noise; the difference of their evidence is
then spread about κ with standard deviation 2√κ. It decides if it is beyond a mention, 6 (Kass and Raftery:
strong).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from zlmreport.language import Language, Words
from zlmreport.machines.course import CircularTest
from zlmreport.machines.design import make_thinned_design
from zlmreport.machines.diagnosis import MachineDiagnosis
from zlmreport.machines.forms import make_plain_form, make_whole_form
from zlmreport.machines.noise import CircleNoise, NoiseModel, Whitened
from zlmreport.machines.study import CircleStudy
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.circle import PLANES
from zlmreport.measurement.units import Unit
from zlmreport.model.effects.circle_effect import CircleEffect, title_parameter

SCHEMA = "zlmreport/machine-plan/1"
#: Lengths of bars that are usual, m.
BARS = (0.05, 0.1, 0.15, 0.3)
_STRONG = 6.0
#: Of a curve's length that the model must leave for the circles to show anything of it.
_LEAST_SHARE = 1e-6
#: A likelihood ratio at which an effect is found half of the time.
_FOUND = 20.0
#: Minutes to prepare a run: at another sense or feed, with another bar, in another plane.
_AGAIN, _ANOTHER_BAR, _ANOTHER_PLANE = 1.0, 8.0, 12.0
_OVERSHOOT = 1.5  # turns: half a turn before and after
_FASTEST = 12.0 / 60.0  # m/s
_READINGS = 360  # of a turn


@dataclass(frozen=True, slots=True)
class RunProposal:
    """A run that might be next."""

    circle: CircularTest  #: As it would be run; its deviations are zero.
    what: Words
    minutes: float
    decides: float  #: Probability that it tells the effects apart.


@dataclass(frozen=True, slots=True)
class VisibleSize:
    """The smallest size of a parameter that circles show half of the time."""

    effect: str
    name: str
    title: Words  #: What pages call it.
    size: float  #: SI.
    unit: Unit
    share: float  #: Of the length of its curve that the model leaves.


@dataclass(frozen=True, slots=True)
class NextRun:
    """What is to be decided, and the runs that do, the best first."""

    between: tuple[CircleEffect, ...]
    proposals: tuple[RunProposal, ...]
    visible: tuple[VisibleSize, ...]


def plan_next_run(diagnosis: MachineDiagnosis, catalogue: Sequence[CircleEffect]) -> NextRun:
    """Return the runs that decide between the leading candidates of a diagnosis."""
    study = diagnosis.complete
    tied = diagnosis.candidates[:1]
    between: tuple[CircleEffect, ...] = ()
    if tied and not diagnosis.found:
        names = {tied[0].effect.identifier, *tied[0].indistinguishable_from}
        between = tuple(each.effect for each in diagnosis.candidates if each.effect.identifier in names)
    if len(between) < 2:
        between = ()
    proposals = []
    for circle, what, minutes in _list_options(study):
        decides = _compute_least_decision(diagnosis, between, circle) if between else 0.0
        proposals.append(RunProposal(circle, what, minutes, decides))
    proposals.sort(key=lambda each: -(each.decides if between else 1.0) / each.minutes)
    return NextRun(between, tuple(proposals), tuple(find_visible_sizes(study, catalogue)))


def _list_options(study: CircleStudy) -> Iterator[tuple[CircularTest, Words, float]]:
    """Yield runs that are not there yet: the other sense, other feeds, other bars, other planes."""
    circles = study.design.circles
    last = circles[-1]
    senses = {int(each) for each in np.unique(study.design.sense)}
    if len(senses) == 1:
        sense = -senses.pop()
        yield _run(last, senses=(sense,)), _OTHER_SENSE, _AGAIN + _estimate_minutes(last, 1)
    feeds = {round(each.nominal.feed, 9) for each in circles}
    for factor in (4.0, 0.25):
        feed = last.nominal.feed * factor
        if feed <= _FASTEST and round(feed, 9) not in feeds and len(feeds) < 3:
            new = _run(last, feed=feed)
            yield new, _OTHER_FEED.given(feed=round(feed * 60e3, 1)), _AGAIN + _estimate_minutes(new, 2)
    used = {round(each.nominal.radius, 6) for each in circles}
    for bar in BARS:
        if bar not in used and 0.3 < bar / last.nominal.radius < 3.5:
            new = _run(last, radius=bar)
            yield new, _OTHER_BAR.given(radius=bar * 1e3), _ANOTHER_BAR + _estimate_minutes(new, 2)
    for plane in PLANES:
        if plane not in study.design.planes:
            new = _run(last, plane=plane)
            yield new, _OTHER_PLANE.given(plane=plane), _ANOTHER_PLANE + _estimate_minutes(new, 2)
    yield _run(last), _REPEAT, _AGAIN + _estimate_minutes(last, 2)


def _estimate_minutes(circle: CircularTest, turns: int) -> float:
    return turns * _OVERSHOOT * 2.0 * math.pi / circle.nominal.angular_speed / 60.0


def _run(circle: CircularTest, senses: tuple[int, ...] = (1, -1), **changed: Any) -> CircularTest:
    """Return a circle as it would be run: whole turns, a reading a degree.

    `changed`: Of its nominal path: feed, radius or plane.
    """
    nominal = replace(circle.nominal, **changed)
    way = (np.arange(_READINGS) + 0.5) * 2.0 * np.pi / _READINGS
    count = _READINGS * len(senses)
    duration = 2.0 * np.pi / nominal.angular_speed
    return replace(
        circle,
        name="next",
        nominal=nominal,
        angle=np.concatenate([sense * way for sense in senses]),
        sense=np.repeat([float(sense) for sense in senses], _READINGS),
        run=np.full(count, int(circle.run.max()) + 1),
        deviation=np.zeros(count),
        time=np.concatenate([index * duration + way / nominal.angular_speed for index in range(len(senses))]),
    )


def _compute_least_decision(
    diagnosis: MachineDiagnosis, between: tuple[CircleEffect, ...], circle: CircularTest
) -> float:
    """Return the least probability, over pairs, with which a run more tells effects apart."""
    study = diagnosis.complete
    design = make_thinned_design([*study.design.circles, circle])
    base = np.concatenate(
        [
            np.zeros((design.count, 0)),
            *(make_whole_form(each.effect, design, each.form.searched).columns for each in study.effects),
        ],
        axis=1,
    )
    whitened = NoiseModel(CircleNoise(design), base, np.zeros((design.count, 0))).whiten(
        study.noise.likeliest
    )
    least = 1.0
    by_name = {each.effect.identifier: each for each in diagnosis.candidates}
    for one in between:
        own = by_name[one.identifier]
        whole = make_whole_form(one, design, own.form.searched)
        values = {each.name: each.value for each in own.estimates}
        curve = sum(
            (values.get(term.name, 0.0) * term.column for term in whole.terms), np.zeros(design.count)
        )
        for other in between:
            if other is one:
                continue
            columns = make_whole_form(other, design, by_name[other.identifier].form.searched).columns
            kappa = _measure_apart(whitened, curve, columns) / study.noise.sigma**2
            beyond = (kappa - _STRONG) / (2.0 * math.sqrt(max(kappa, 1e-12)))
            least = min(least, 0.5 * (1.0 + math.erf(beyond / math.sqrt(2.0))))
    return least


def _measure_apart(whitened: Whitened, curve: FloatArray, columns: FloatArray) -> float:
    """Return the squared length of a curve that columns leave of it."""
    own = whitened.whiten(curve[:, np.newaxis])
    length = float(whitened.multiply(own, own)[0, 0])
    return length - whitened.measure_explained(whitened.whiten(columns), own)


def find_visible_sizes(study: CircleStudy, catalogue: Sequence[CircleEffect]) -> Iterator[VisibleSize]:
    """Yield the smallest size of each plain effect that circles show half of the time."""
    whitened = study.whitened
    for effect in catalogue:
        is_searched = any(each.is_refined for each in effect.searched)
        if is_searched or effect.is_base or effect.identifier in study.names:
            continue
        for term in make_plain_form(effect, study.design).terms:
            own = whitened.whiten(term.column[:, np.newaxis])
            left, full = float(whitened.multiply(own, own)[0, 0]), float(np.sum(own**2))
            if left > _LEAST_SHARE * full:
                size = study.noise.sigma * math.sqrt(_FOUND / left)
                yield VisibleSize(
                    effect.identifier, term.name, title_parameter(term), size, term.unit, left / full
                )


def plan_values(found: NextRun, language: Language = Language.ENGLISH) -> dict[str, Any]:
    """Return the next run as plain values."""
    return {
        "schema": SCHEMA,
        "decides_between": [each.identifier for each in found.between],
        "proposals": [
            {
                "statement": each.what.in_language(language),
                "run": {
                    "plane": each.circle.nominal.plane,
                    "radius": each.circle.nominal.radius * 1e3,
                    "feed": each.circle.nominal.feed * 60e3,
                    "centre": [place * 1e3 for place in each.circle.nominal.centre],
                    "senses": [
                        "ccw" if sense > 0 else "cw" for sense in np.unique(each.circle.sense).tolist()
                    ],
                },
                "minutes": round(each.minutes, 1),
                "decides": each.decides if found.between else None,
            }
            for each in found.proposals
        ],
        "smallest_visible": [
            {
                "effect": each.effect,
                "name": each.name,
                "value": each.unit.from_si(each.size),
                "unit": each.unit.ascii,
                "share_left": each.share,
            }
            for each in found.visible
        ],
    }


_OTHER_SENSE = Words("the same circle in the other sense")
_OTHER_FEED = Words("the same circle at {feed} mm/min, in both senses")
_OTHER_BAR = Words("a bar of {radius} mm, in both senses")
_OTHER_PLANE = Words("plane {plane}, in both senses")
_REPEAT = Words("the same circle again, in both senses")
