"""Where to look for what has no name, and what to measure next: the advice in sentences.

What stays at its place when it is measured again at closer targets is in the machine; what moves with the
time, the direction or the set-up shows itself where everything else stands still. So each course asks for a
measurement in which only that changes with which the remainder does. Engineering experience; no standard
states it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis.random_curves import Along, Course
from zlmreport.model.diagnosis.remainder import Remainder
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design

#: Into how many parts the distance of the targets is divided where a remainder is smooth, and where it is
#: not: a period has to be caught by four steps and more. No whole numbers: steps that go into the distance
#: are blind to what goes into them, and so to the very periods to which the targets were blind.
_CLOSER, _FINE = 4.1, 9.1
#: The longest step of a fine run, mm or °: a quarter of the teeth of common belts and of the turns of common
#: screws, from 5 mm upwards, and of none of them a whole part.
_LONGEST_FINE = 1.1

_OVER_POSITION = Words("the residuals over the position, {where}")
_REVERSAL_OVER_POSITION = Words("the difference of the two directions over the position, {where}")
_OVER_TIME = Words("the residuals over the time, {where}")
_SLOPES_OVER_TIME = Words("the residuals of the outermost targets over the time, {where}")
_REVERSAL_OVER_TIME = Words("the difference of the two directions over the time, {where}")
_RUN_OVER_POSITION = Words("the residuals of the first and of the last run over the position, {where}")
_RUN_BY_RUN = Words("the residuals run by run, {where}")

_CLOSER_TARGETS = Words(
    "two runs with a target every {step} from {first} to {last}: what is in the machine comes "
    "again at the same places"
)
_FINE_RUN = Words(
    "a fine run in steps of {step} from {first} to {last}, twice: a period shorter than the "
    "distance of the targets looks irregular, and shows itself there"
)
_FINE_REVERSAL = Words(
    "a fine run in both directions in steps of {step} from {first} to {last}, twice: a period shorter than "
    "the distance of the targets looks irregular, and shows itself there"
)
_OTHER_OVERRUN = Words(
    "both directions with a target every {step} from {first} to {last}, once as before and once "
    "with twice the overrun: lost motion stays, what relaxes or winds up changes"
)
_ONE_TARGET = Words(
    "one target again and again, for {duration}, with the temperatures of scale, screw and air "
    "logged: what moves there is no matter of the position"
)
_BOTH_ENDS = Words(
    "the first and the last target in turn, for {duration}, with the temperatures of scale, screw "
    "and air logged: it shows what grows, and from where"
)
_BOTH_DIRECTIONS = Words(
    "one target from both directions in turn, for {duration}: whether the reversal changes with "
    "the time or only with the place"
)
_COLD_AND_WARM = Words(
    "one run cold, and one every quarter of an hour while the axis works, with the temperatures of scale, "
    "screw and air logged: whether the curve along the axis grows with one of them"
)
_MORE_RUNS = Words(
    "three runs more, the first target read before and after each, nothing touched between: a "
    "set-up that is not firm moves there too"
)
_TEN_TIMES = Words(
    "this target ten times from each direction: whether it always stands off, or scatters more there"
)
_WHERE = {
    Course.PLACE: _OVER_POSITION,
    Course.IRREGULAR: _OVER_POSITION,
    Course.IRREGULAR_REVERSAL: _REVERSAL_OVER_POSITION,
    Course.TARGET: _OVER_POSITION,
    Course.REVERSAL: _REVERSAL_OVER_POSITION,
    Course.TIME: _OVER_TIME,
    Course.SLOPE: _SLOPES_OVER_TIME,
    Course.REVERSAL_IN_TIME: _REVERSAL_OVER_TIME,
    Course.PLACE_IN_TIME: _RUN_OVER_POSITION,
    Course.RUNS: _RUN_BY_RUN,
}
_MEASURE = {
    Course.PLACE: _CLOSER_TARGETS,
    Course.IRREGULAR: _FINE_RUN,
    Course.IRREGULAR_REVERSAL: _FINE_REVERSAL,
    Course.TARGET: _TEN_TIMES,
    Course.REVERSAL: _OTHER_OVERRUN,
    Course.TIME: _ONE_TARGET,
    Course.SLOPE: _BOTH_ENDS,
    Course.REVERSAL_IN_TIME: _BOTH_DIRECTIONS,
    Course.PLACE_IN_TIME: _COLD_AND_WARM,
    Course.RUNS: _MORE_RUNS,
}


@dataclass(frozen=True, slots=True)
class WhereToLook:
    """What to do about something without a name."""

    at: Words  #: Where it shows in what was measured: "the residuals over the position, around 420 mm".
    measure: Words  #: What to measure that would tell more.


def look_for(remainder: Remainder, design: Design) -> WhereToLook:
    """Return where to look for a remainder, and what to measure."""
    course = remainder.course
    given: dict[str, Words] = {}
    if course.along is Along.PLACE:
        first, last, step = _choose_stretch(remainder, design)
        axis = design.axis
        given = {
            "first": wording.position(axis, first),
            "last": wording.position(axis, last),
            "step": wording.length(axis, _choose_step(step, axis, is_fine=course.is_irregular)),
        }
    elif course.along is Along.TIME:
        given = {"duration": wording.span_of_time(design, design.duration)}
    return WhereToLook(_WHERE[course].given(where=remainder.where), _MEASURE[course].given(**given))


def _choose_stretch(remainder: Remainder, design: Design) -> tuple[float, float, float]:
    """Return from where to where to measure closer, and the distance of the targets there, m or rad.

    What is irregular is so everywhere: two distances about its largest place are enough.
    """
    targets = design.target_positions
    step = float(np.median(np.diff(targets))) if len(targets) > 1 else 0.0
    first, last = remainder.low - step, remainder.high + step
    if remainder.course.is_irregular:
        middle = min(max(remainder.peak, targets[0] + step), targets[-1] - step)
        first, last = middle - step, middle + step
    return max(float(targets[0]), first), min(float(targets[-1]), last), step


def _choose_step(distance: float, axis: Axis, *, is_fine: bool) -> float:
    """Return the step of a run that is to show more than targets at a distance do, both m or rad."""
    if not is_fine:
        return distance / _CLOSER
    return min(distance / _FINE, axis.position_unit.to_si(_LONGEST_FINE))
