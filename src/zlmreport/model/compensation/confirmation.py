"""Whether a second test confirms the forecast of a table, and if not how the table acts instead.

What went between the tests is held against what a control takes away that was given the table as it was made,
and against what it takes away by each mistake that is known: another sign, a part of it, other positions, the
directions exchanged.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis
from zlmreport.model.compensation.basis import TableBasis
from zlmreport.model.compensation.curve import CompensationTable, ErrorCurve, halve_play

#: A part of the table that was applied is taken for 1, 2, ½, 0 or −1 within this.
_NEAR = 0.2
#: A part that is known no better says nothing.
_UNKNOWN = 0.5
#: Of the deviations before, what may be left beside the scatter of the means.
_MAY_BE_LEFT = 0.05
#: By how much a shift, or another play, must make the rest smaller to be the reason.
_FAR_SMALLER = 3.0
#: Up to which ratio of what they leave a part of the table goes before these, which have more freedom.
_ALIKE = 1.25
#: By how many rows a table may be shifted: where to begin, and about the best of these.
_SHIFTS, _FINE_SHIFTS = np.linspace(-3, 3, 121), np.linspace(-0.05, 0.05, 41)


class ConfirmationVerdict(StrEnum):
    """What became of a table."""

    HELD = "held"
    WRONG_SIGN = "wrong-sign"
    HALF = "half"
    DOUBLE = "double"
    NOT_IN_EFFECT = "not-in-effect"
    SHIFTED = "shifted"
    #: What parts the directions is added where it is to be taken away; taken away twice; or not at all.
    PLAY_TURNED = "play-turned"
    PLAY_TWICE = "play-twice"
    PLAY_LEFT = "play-left"
    OTHER = "other"

    @property
    def promised(self) -> ConfirmationVerdict:
        """The one of the first five, which programs know, that it counts as."""
        return self if self in _FIRST else ConfirmationVerdict.OTHER


_FIRST = {
    ConfirmationVerdict.HELD,
    ConfirmationVerdict.WRONG_SIGN,
    ConfirmationVerdict.HALF,
    ConfirmationVerdict.SHIFTED,
}
#: What part of a table a control applies that does something else with it.
_PARTS = {
    -1.0: ConfirmationVerdict.WRONG_SIGN,
    0.5: ConfirmationVerdict.HALF,
    2.0: ConfirmationVerdict.DOUBLE,
    0.0: ConfirmationVerdict.NOT_IN_EFFECT,
}
#: What part of the play it takes that takes what both directions share as it should.
_PLAYS = {
    -1.0: ConfirmationVerdict.PLAY_TURNED,
    2.0: ConfirmationVerdict.PLAY_TWICE,
    0.0: ConfirmationVerdict.PLAY_LEFT,
}


@dataclass(frozen=True, slots=True)
class Confirmation:
    """How a second test stands to the forecast."""

    verdict: ConfirmationVerdict  #: What became of the table.
    ratio: float  #: E after over E before.
    applied: float  #: What part of the table the second test shows to have been applied.
    #: Of that part by the scatter of both tests, k = 2; infinite where the table takes nothing away.
    expanded_uncertainty: float
    #: Whether the control's backlash parameter takes the play that a table without directions leaves.
    has_backlash: bool = False
    shift: float = 0.0  #: By how much the table seems shifted, m or rad; 0 unless that is the verdict.
    #: left and rest: Of what went between the tests, root mean squares of what the table as it was made does
    #: not take away, and the table as the verdict has it, m or rad.
    left: float = 0.0
    rest: float = 0.0

    @property
    def is_seen(self) -> bool:
        """Whether the second test tells what part of the table was applied."""
        return self.expanded_uncertainty < _UNKNOWN


def confirm(  # noqa: PLR0913, PLR0917 - two tests, and the tables of both
    basis: TableBasis,
    after: ErrorCurve,
    axis: Axis,
    table: CompensationTable,
    place: Place,
    active: CompensationTable | None = None,
    play: float = 0.0,
) -> Confirmation:
    """Hold a second test against the table that the first one gave.

    `basis`: What is known of the axis from the first test; between its targets, too.
    `axis`: That of the second test.
    `active`: The table that was active during the first test, and that this one replaces.
    `play`: What this one leaves to the control's backlash parameter, m or rad.

    Raises `InputError` if the two tests are of different axes, or have no common length or direction.
    """
    if (axis.name, axis.kind) != (table.axis.name, table.axis.kind):
        raise InputError.at(
            place,
            f"it is a test of axis {axis.name} ({axis.kind}), and the table is of axis {table.axis.name} "
            f"({table.axis.kind}); name the test of that axis",
        )
    before = basis.curve
    common = [each.index for each in before.approaches if each in after.approaches]
    if not common:
        raise InputError.at(
            place, "was approached from the other side only; the test before tells nothing of it"
        )
    inside = (after.positions >= before.positions[0] - 1e-9) & (
        after.positions <= before.positions[-1] + 1e-9
    )
    positions = after.positions[inside]
    if len(positions) < 2:
        raise InputError.at(place, "has no two targets within the length of the test before")
    was = basis.known(positions)[common]
    is_now = np.stack([after.forward, after.reverse])[common][:, inside]
    ratio = float(np.ptp(is_now) / np.ptp(was)) if np.ptp(was) else 1.0
    taken = table.at(positions)[common]
    # Of the axis without a table, but for a constant: each test has its own zero.
    removed = was + (active.at(positions)[common] if active else 0.0) - is_now
    by_backlash = _find_taken_play(removed, play)
    own = removed - by_backlash
    applied = _fit_part(own, taken)
    left = _compute_rms(_centre(own - taken))
    scatter = _compute_scatter(before, after)
    allowed = scatter + _MAY_BE_LEFT * _compute_rms(was - was.mean())
    of_table = _compute_rms(_centre(taken)) * np.sqrt(taken.size)
    expanded = float(scatter / of_table) if of_table else np.inf

    def make_confirmation(
        verdict: ConfirmationVerdict, rest: float = left, shift: float = 0.0
    ) -> Confirmation:
        return Confirmation(verdict, ratio, applied, expanded, bool(by_backlash.any()), shift, left, rest)

    if abs(applied - 1) < max(_NEAR, expanded) and left <= allowed:
        return make_confirmation(ConfirmationVerdict.HELD)
    part, known = min(_PARTS.items(), key=lambda each: abs(applied - each[0]))
    of_part = _compute_rms(_centre(own - part * taken))
    shift, rest = _fit_shift(own, positions, table, common)
    best = (rest, ConfirmationVerdict.SHIFTED)
    if len(common) > 1:
        shared = taken.mean(axis=0)
        parting = taken - shared + halve_play(play)
        plays = (
            (_compute_rms(_centre(removed - shared - part * parting)), verdict)
            for part, verdict in _PLAYS.items()
        )
        best = min((best, *(each for each in plays if each[0] <= 2 * allowed)))
    is_part = expanded < _UNKNOWN and abs(applied - part) < _NEAR and of_part <= 2 * allowed
    if is_part and of_part <= _ALIKE * best[0]:
        return make_confirmation(known, of_part)
    rest, verdict = best
    if rest * _FAR_SMALLER < left:
        return make_confirmation(verdict, rest, shift if verdict is ConfirmationVerdict.SHIFTED else 0.0)
    return make_confirmation(ConfirmationVerdict.OTHER)


def _find_taken_play(removed: FloatArray, play: float) -> FloatArray:
    """Return what a backlash parameter took of each direction, shape (d, 1): half of a play each, or nothing.

    `removed`, (d, m): By table and parameter, in the directions of both tests, m or rad.
    """
    if len(removed) < 2:
        return np.zeros((1, 1))
    gone = float(np.mean(removed[0] - removed[1]))
    return halve_play(play if abs(gone - play) < abs(gone) else 0.0)


def _fit_part(removed: FloatArray, table: FloatArray) -> float:
    """Return what part of a table was removed, by least squares, the zero of each test left open."""
    x, y = _centre(table).ravel(), _centre(removed).ravel()
    return float(x @ y / (x @ x)) if x @ x else 0.0


def _fit_shift(
    removed: FloatArray, positions: FloatArray, table: CompensationTable, common: Sequence[int]
) -> tuple[float, float]:
    """Return the shift of the table that explains most, and what it leaves in the common directions."""
    step = float(np.median(np.diff(table.positions)))

    def find_best(shifts: FloatArray) -> tuple[float, float]:
        return min(
            (_compute_rms(_centre(removed - table.at(positions - part * step)[common])), part)
            for part in shifts.tolist()
        )

    _, near = find_best(_SHIFTS)
    rest, part = find_best(near + _FINE_SHIFTS)
    return part * step, rest


def _compute_scatter(before: ErrorCurve, after: ErrorCurve) -> float:
    """Return twice the standard deviation of a difference of two means, by the scatter of both tests."""
    parts = [
        float(np.nanmean(each.spread**2)) / max(1, each.runs)
        for each in (before, after)
        if np.isfinite(each.spread).any()
    ]
    return 2 * float(np.sqrt(sum(parts)))


def _centre(values: FloatArray) -> FloatArray:
    centred: FloatArray = values - values.mean()
    return centred


def _compute_rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
