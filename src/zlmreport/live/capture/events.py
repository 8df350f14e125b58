"""What happens while an axis is followed: each event is a fact that is written down, or shown, or both."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from zlmreport.live.capture.visits import ListedVisit
from zlmreport.measurement.approach import Approach


@dataclass(frozen=True, slots=True)
class Mean:
    """The mean of the readings over the later half of the dwell."""

    value: float  #: By the instrument's own zero, m or rad.
    range: float  #: Largest − smallest over the whole dwell, m or rad.
    count: int  #: How many readings were averaged.
    skipped: int  #: How many among them did not arrive or were not understood.
    time: float  #: Of the last, s, by the clock of the readings.
    duration: float  #: From the first to the last, s.
    #: Beside the last, SI, under the names of `zlmreport.measurement.measurement_set`.
    conditions: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class DatumTaken:
    """The reading at the datum: the axis is known to stand at a position there, m or rad."""

    position: float
    mean: Mean


@dataclass(frozen=True, slots=True)
class MovedBeforeDatum:
    """The axis moved before the reading at the datum was taken: nobody knows where it stands now."""

    position: float  #: Where the axis is to stand for the datum, m or rad.


@dataclass(frozen=True, slots=True)
class DatumHolds:
    """After an interruption, the axis read the same again at a target that was read before.

    Attributes
    ----------
    visit
        The earlier one.
    difference
        Now − then, m or rad.
    """

    visit: ListedVisit
    difference: float


@dataclass(frozen=True, slots=True)
class DatumMoved:
    """After an interruption, the axis did not read the same: the datum is another one.

    Attributes
    ----------
    visit
        The earlier one.
    difference
        Now − then, m or rad.
    void
        The visits that are no longer valid to take: the rest of the part.
    """

    visit: ListedVisit
    difference: float
    void: tuple[ListedVisit, ...]


@dataclass(frozen=True, slots=True)
class NotChecked:
    """After an interruption, the axis stands at a target that was not read before from this side."""

    target: int
    approach: Approach


@dataclass(frozen=True, slots=True)
class Moving:
    """The axis is on its way to the visit that is next."""

    visit: ListedVisit


@dataclass(frozen=True, slots=True)
class Settling:
    """The axis is inside the tolerance of the visit that is next, and a reading may be taken."""

    visit: ListedVisit


@dataclass(frozen=True, slots=True)
class Recorded:
    """A reading was taken.

    Attributes
    ----------
    visit
        The visit.
    attempt
        At its part of the test, from 1.
    position
        Actual position, m or rad: the mean, seen from the datum.
    mean
        What it was made of.
    late
        How long after the reading its visit was known, s.
    """

    visit: ListedVisit
    attempt: int
    position: float
    mean: Mean
    late: float = 0.0

    @property
    def deviation(self) -> float:
        """Actual − target, m or rad."""
        return self.position - self.visit.position


@dataclass(frozen=True, slots=True)
class Passed:
    """The axis was at a target and left again, and nothing was taken; it may still come back."""

    visit: ListedVisit
    seconds: float  #: How long it was inside the tolerance.
    #: How fast what was shown went on there, m/s or rad/s, too slow for a motion; None if it did not.
    drift: float | None = None


@dataclass(frozen=True, slots=True)
class Missed:
    """A visit that will not be: the axis stands still at a later one."""

    visit: ListedVisit
    attempt: int


@dataclass(frozen=True, slots=True)
class Repeated:
    """The axis stands still at a visit that was read before, and its reading stays as it is."""

    visit: ListedVisit
    #: Where it stands now, m or rad; None in journals of older versions, as the mean.
    position: float | None = None
    mean: Mean | None = None  #: The reading that is not taken.


@dataclass(frozen=True, slots=True)
class WrongDirection:
    """The axis came to the target that is next from the other side."""

    visit: ListedVisit
    approach: Approach | None  #: How it came; None if it is not known, because no motion was seen.


@dataclass(frozen=True, slots=True)
class NotNext:
    """The axis stands still at a target, having come from a side, where nothing is to be read now."""

    target: int  #: Its number, from 1.
    approach: Approach  #: How the axis came there.
    visit: ListedVisit  #: The visit that is next.


@dataclass(frozen=True, slots=True)
class Unclear:
    """The axis stands still at a target, and what went before does not say which visit it is."""

    target: int  #: Its number, from 1.
    approach: Approach  #: How the axis came there.
    #: What it may be, with the probability of each, most probable first; None for no visit at all.
    candidates: tuple[tuple[ListedVisit | None, float], ...]
    position: float  #: Actual position, m or rad: the mean, seen from the datum.
    mean: Mean  #: The reading, to be filed when somebody says where.
    #: Where it should stand by what was read before, m or rad, if the visit is clear and its reading is not
    #: plausible; else None.
    expected: float | None = None


@dataclass(frozen=True, slots=True)
class Placed:
    """The operator said which visit an unclear stop is; None for no visit at all."""

    visit: ListedVisit | None


@dataclass(frozen=True, slots=True)
class Presumed:
    """It is nearly clear which visit the next reading is, and so it is taken."""

    visit: ListedVisit
    share: float  #: How probable it is.


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """The axis stands still at a position that is no target: a pause, a wrong datum, or a wrong display."""

    position: float  #: Where it seems to stand, m or rad.
    #: By which what the display shows must be multiplied, so that the axis stands at a visit that is next;
    #: None if there is no such one.
    factor: float | None = None


@dataclass(frozen=True, slots=True)
class Frozen:
    """What the display shows has not changed in the least for longer than the axis rests, s."""

    seconds: float


@dataclass(frozen=True, slots=True)
class ZeroLost:
    """The instrument lost its zero: no later reading compares with an earlier one.

    Attributes
    ----------
    message
        What happened, for the operator.
    void
        The visits that can no longer be taken: the rest of the part. What was taken stays.
    """

    message: str
    void: tuple[ListedVisit, ...]


@dataclass(frozen=True, slots=True)
class ScaleChanged:
    """The display was switched to another unit, or its scale changed: nothing that it shows now compares."""

    factor: float  #: By which what it shows must be multiplied.
    #: What is taken again, for its reading may be by the other unit already: a target near the display's own
    #: zero looks the same by both; None for none.
    visit: ListedVisit | None


@dataclass(frozen=True, slots=True)
class BeamHeld:
    """The beam was broken while the axis stood still, and the display shows what it showed before."""

    message: str  #: What had happened, for the operator.
    seconds: float  #: How long no sound reading came.


@dataclass(frozen=True, slots=True)
class TrackLost:
    """No sound reading came for so long that a visit may have gone unseen, s."""

    silence: float


@dataclass(frozen=True, slots=True)
class TooSlow:
    """Readings come so seldom that the axis could turn round, or move and stand again, between two."""

    spacing: float  #: Between readings, s.
    largest: float  #: What it may be, s.


@dataclass(frozen=True, slots=True)
class Closed:
    """The axis came back to the datum after its last visit.

    Attributes
    ----------
    difference
        Reading there − datum, m or rad: what instrument and axis slipped or drifted since it was taken.
    holds
        Whether that is less than what counts as motion.
    """

    difference: float
    holds: bool


@dataclass(frozen=True, slots=True)
class Finished:
    """The last visit was taken, or missed for good."""


@dataclass(frozen=True, slots=True)
class Interrupted:
    """The capture ended before the test was over: the user ended it, or the instrument was gone."""

    reason: str


@dataclass(frozen=True, slots=True)
class Resumed:
    """The capture goes on after a time in which nobody watched the instrument."""


@dataclass(frozen=True, slots=True)
class Ended:
    """The user closed the test: what was not taken is missing."""


@dataclass(frozen=True, slots=True)
class Retake:
    """The operator takes visits again, the first to the last; until then their earlier readings stay."""

    first: ListedVisit
    last: ListedVisit


@dataclass(frozen=True, slots=True)
class Skipped:
    """The operator leaves out the visit that is next."""

    visit: ListedVisit


@dataclass(frozen=True, slots=True)
class Commented:
    """The operator has something to say, after the visit that was taken last."""

    text: str


Event: TypeAlias = (
    DatumTaken
    | MovedBeforeDatum
    | DatumHolds
    | DatumMoved
    | NotChecked
    | Moving
    | Settling
    | Recorded
    | Passed
    | Missed
    | Repeated
    | WrongDirection
    | NotNext
    | Unclear
    | Placed
    | Presumed
    | Elsewhere
    | Frozen
    | ZeroLost
    | ScaleChanged
    | BeamHeld
    | TrackLost
    | TooSlow
    | Closed
    | Finished
    | Interrupted
    | Resumed
    | Ended
    | Retake
    | Skipped
    | Commented
)

#: What an operator orders while a capture goes on.
Order: TypeAlias = Retake | Skipped | Commented

#: After these nothing is taken any more until an operator has seen to it.
HALTING = (MovedBeforeDatum, DatumMoved, ZeroLost, ScaleChanged, TooSlow, Finished)
