"""Every sentence that an operator reads while capturing: what happened, and what to do next.

At a terminal in English, on a page in its language: the sentences stand here once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isclose

from zlmreport.language import Words, named
from zlmreport.language.formatting import MINUS
from zlmreport.language.writer import LanguageWriter
from zlmreport.live.capture.display import DEGREES
from zlmreport.live.capture.events import (
    BeamHeld,
    Closed,
    Commented,
    DatumHolds,
    DatumMoved,
    DatumTaken,
    Elsewhere,
    Event,
    Frozen,
    Missed,
    MovedBeforeDatum,
    NotChecked,
    NotNext,
    Passed,
    Placed,
    Presumed,
    Recorded,
    Repeated,
    Retake,
    ScaleChanged,
    Skipped,
    TooSlow,
    TrackLost,
    Unclear,
    WrongDirection,
    ZeroLost,
)
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.visits import ListedVisit
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import with_unit

#: Where an axis comes from, by its direction.
SIDES = {Approach.POSITIVE: Words("from below"), Approach.NEGATIVE: Words("from above")}
#: The least probability of an explanation that is named.
WORTH_NAMING = 0.005
_INCH, _THOUSAND = 25.4, 1000.0

# In which of few words a line begins; in capitals what an operator looks at.
_DATUM = Words("datum", context="capture")
_CLOSURE = Words("closure", context="capture")
_PASSED = Words("passed", context="capture")
_MISSED = Words("MISSED", context="capture")
_AGAIN = Words("again", context="capture")
_WRONG = Words("WRONG", context="capture")
_OTHER = Words("OTHER", context="capture")
_SILENT = Words("SILENT", context="capture")
_BEAM = Words("beam", context="capture")
_FROZEN = Words("FROZEN", context="capture")
_DISPLAY = Words("DISPLAY", context="capture")
_DOUBT = Words("DOUBT", context="capture")
_WHERE = Words("WHERE?", context="capture")
_LIKELY = Words("likely", context="capture")
_PLACED = Words("placed", context="capture")
_RETAKE = Words("RETAKE", context="capture")
_SKIPPED = Words("skipped", context="capture")
_COMMENT = Words("comment", context="capture")

_VISIT = Words("run {run} {arrow} {position}")
_TAKEN_FOR = Words("the reading is taken for {position}")
_HOLDS = Words("holds: {difference} against visit {number}")
_CLOSED = Words("{difference} at the datum")
_SLIPPED = Words("{difference} at the datum: it slipped, and what was read since it was taken is marked")
_NOT_READ_BEFORE = Words("target {target} {arrow} was not read before: nothing is taken")
_READ = Words("{visit}  {deviation}  range {range}")
_NOTHING_TAKEN = Words("{visit}: nothing taken, it was there for {seconds} s")
_DRIFTING = Words(
    "{visit}: nothing taken, it was there for {seconds} s, drifting {drift} a second: let the axis and "
    "the instrument settle, or look what moves the optics"
)
_STANDS_LATER = Words("{visit}: the axis stands at a later one")
_GONE_ON = Words("{visit}: the axis has gone on from its reading, which stays")
_CAME_WRONG = Words("{visit}: it came {side}; let it come {right}")
_CAME_UNSEEN = Words("{visit}: no motion towards it was seen; let it come {right}")
_IS_NOT_NEXT = Words("target {target} {arrow} is not next; next is {visit}")
_NO_READING = Words("no sound reading came for {seconds} s; visits may have gone unseen")
_BACK_AGAIN = Words("back after {seconds} s, and the display shows what it showed: {message}")
_STANDS_STILL = Words(
    "the display has shown the same for {seconds} s: if the program runs on, the display stands still: "
    "look at its hold key and its line"
)
_NO_TARGET = Words("no target at {position}, where it stands; is the datum right?")
_MISREAD = Words("{position} is no target, {why}")
_MAY_BE = Words("target {target} {arrow}: {candidates}")
_TAKEN_AS_LIKELY = Words("{visit}: {share} % sure, and taken for it")
_NO_VISIT = Words("no visit")
_TAKE_ONE = Words("visit {first}: let the axis come to {visit} {side}")
_TAKE_SEVERAL = Words("visit {first} to {last}: let the axis come to {visit} {side}")
_LEFT_OUT = Words("{visit}: left out, as you said")

_DATUM_UNKNOWN = Words(
    "the axis moved before the reading at {position} was taken for its datum, and where it stands now is "
    "not known: stop the program. If it had stood still, its readings scatter by more than the key stability "
    "allows: state a larger one"
)
_HAS_MOVED = Words("the datum has moved by {difference} since visit {number} was read. {void}")
_TOO_SELDOM = Words(
    "readings come every {spacing} s, and more than {largest} s apart the axis could turn round unseen: "
    "let the instrument send more often (its key rate), or state a larger plan.overrun, a lower "
    "measurement.feed or a longer measurement.source.dwell"
)
_READINGS_ENDED = Words("the readings ended")
_ZERO_LOST = Words("{message}. {void}")
_LOST_ITS_ZERO = Words("the instrument lost its zero")
_SWITCHED = Words("{switched}, and nothing of it is taken. Set it back: what was read stays")
_SWITCHED_AGAIN = Words(
    "{switched}, and nothing of it is taken; visit {number} is taken again, for it may have been read so."
    " Set it back: what was read stays"
)
_TO_INCHES = Words("the display was switched to inches")
_TO_MILLIMETRES = Words("the display was switched from inches to millimetres")
_TO_ANOTHER = Words("the display was switched to another unit: {factor} times what it shows is right")
_READ_DEPARTS = Words("the reading at visit {number} ({visit}) {departs}")
_LEAVES_OPEN = Words(
    "the axis stands at target {target} {arrow}, {position}, and what it did before leaves open which "
    "visit that is: {candidates}"
)
_DEPARTS = Words(
    "departs by {difference} from what was read before and from the plan, more than an axis does: a stop "
    "short of its target, a datum that slipped, or a display that fails"
)
_MIRRORED = Words("but its mirror image is: the display counts the other way; turn the instrument's key sign")
_SHOWS_INCHES = Words("but 25.4 times it is: the display shows inches; set it to millimetres")
_SHOWS_MILLIMETRES = Words("but a 25.4th of it is: the display shows millimetres as inches; set it to inches")
_SHOWS_DEGREES = Words(
    "but as degrees it is, and it is read as millimetres: set the instrument's key unit to deg"
)
_OTHER_UNIT = Words("but {factor} times it is: the display's unit is another one; set it, or the key scale")
_OTHER_PATH = Words("but {factor} times it is: the optics' path is counted otherwise; set the key scale")
_CANDIDATE = Words("visit {visit} (run {run}) {share} %")
_NO_CANDIDATE = Words("no visit {share} %")
_ONE_VOID = Words(
    "The datum is gone: visit {first} is void, from {position} {arrow} of run {run} on. What was taken "
    "before stays"
)
_SEVERAL_VOID = Words(
    "The datum is gone: visits {first} to {last} are void, from {position} {arrow} of run {run} on. What "
    "was taken before stays"
)

_LOOK_AGAIN = Words("let the program go on to {position}, for the closing look at the datum")
_START = Words("start the program at visit {visit}: {position} {side}, run {run}")
_START_AGAIN = Words("start the program at visit {visit}: {position} {side}, run {run}, attempt {attempt}")
_GO_ON = Words("go on with the program at visit {visit}: {position} {side}, run {run}")
_GO_ON_AGAIN = Words(
    "go on with the program at visit {visit}: {position} {side}, run {run}, attempt {attempt}"
)
_STAND_STILL = Words("let the axis stand still at {position}, for the datum")
_COME_BACK = Words("let the axis come once more to {position} {side}, to check the datum")
_SET_ZERO = Words("set the instrument's zero as it was when the capture began")


@dataclass(frozen=True, slots=True)
class CaptureLine:
    """What happened: how it is called, empty for nothing, and what is said of it."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class AxisWriter(LanguageWriter):
    """Writes positions and deviations of an axis, and sentences on them, in one language."""

    axis: Axis

    def write_position(self, value: float, decimals: int = 3) -> str:
        """Write a position in mm or °."""
        unit = self.axis.position_unit
        return with_unit(self.write_number(unit.from_si(value), decimals), unit.symbol)

    def write_deviation(self, value: float) -> str:
        """Write a deviation in µm or ″, with its sign."""
        number = self.write_small_length(value)
        return number if number.startswith(MINUS) else f"+{number}"

    def write_small_length(self, value: float) -> str:
        """Write a small length in µm or ″."""
        unit = self.axis.deviation_unit
        return with_unit(self.write_number(unit.from_si(value), 2), unit.symbol)

    def name_visit(self, visit: ListedVisit) -> str:
        """Name a visit: ``run 2 ↑  150.000 mm``."""
        position = f"{self.write_position(visit.position):>12}"
        return self.say(_VISIT.given(run=visit.run, arrow=visit.approach.arrow, position=position))


def tell_event(event: Event, visits: int, writer: AxisWriter) -> CaptureLine | None:
    """Return what an operator reads of an event; None for those that only a display shows."""
    match event:
        case DatumTaken(position=position):
            return _tell_line(_DATUM, _TAKEN_FOR.given(position=writer.write_position(position)), writer)
        case DatumHolds(visit=visit, difference=difference):
            said = _HOLDS.given(difference=writer.write_deviation(difference), number=visit.number)
            return _tell_line(_DATUM, said, writer)
        case Closed(difference=difference, holds=holds):
            said = (_CLOSED if holds else _SLIPPED).given(difference=writer.write_deviation(difference))
            return _tell_line(_CLOSURE, said, writer)
        case NotChecked(target=target, approach=approach):
            return _tell_line(_DATUM, _NOT_READ_BEFORE.given(target=target, arrow=approach.arrow), writer)
        case Recorded(visit=visit, mean=mean):
            number = f"{visit.number:>{len(str(visits))}}/{visits}"
            deviation = f"{writer.write_deviation(event.deviation):>12}"
            said = _READ.given(
                visit=writer.name_visit(visit),
                deviation=deviation,
                range=writer.write_small_length(mean.range),
            )
            return CaptureLine(number, writer.say(said))
        case _:
            return _tell_out_of_order(event, writer)


def _tell_line(name: Words, said: Words, writer: AxisWriter) -> CaptureLine:
    return CaptureLine(writer.say(name), writer.say(said))


def _tell_out_of_order(event: Event, writer: AxisWriter) -> CaptureLine | None:
    line: CaptureLine | None = None
    match event:
        case Passed(visit=visit, seconds=seconds, drift=drift):
            said = (_NOTHING_TAKEN if drift is None else _DRIFTING).given(
                visit=writer.name_visit(visit),
                seconds=writer.write_number(seconds, 1),
                drift=writer.write_deviation(drift or 0.0),
            )
            line = _tell_line(_PASSED, said, writer)
        case Missed(visit=visit):
            line = _tell_line(_MISSED, _STANDS_LATER.given(visit=writer.name_visit(visit)), writer)
        case Repeated(visit=visit):
            line = _tell_line(_AGAIN, _GONE_ON.given(visit=writer.name_visit(visit)), writer)
        case WrongDirection(visit=visit, approach=None):
            said = _CAME_UNSEEN.given(visit=writer.name_visit(visit), right=SIDES[visit.approach])
            line = _tell_line(_WRONG, said, writer)
        case WrongDirection(visit=visit, approach=Approach() as approach):
            named, right = writer.name_visit(visit), SIDES[visit.approach]
            line = _tell_line(
                _WRONG, _CAME_WRONG.given(visit=named, side=SIDES[approach], right=right), writer
            )
        case NotNext(target=target, approach=approach, visit=visit):
            said = _IS_NOT_NEXT.given(target=target, arrow=approach.arrow, visit=writer.name_visit(visit))
            line = _tell_line(_OTHER, said, writer)
        case _:
            line = _tell_out_of_sight(event, writer)
    return line


def _tell_out_of_sight(event: Event, writer: AxisWriter) -> CaptureLine | None:
    line: CaptureLine | None = None
    match event:
        case TrackLost(silence=silence):
            line = _tell_line(_SILENT, _NO_READING.given(seconds=writer.write_number(silence, 1)), writer)
        case BeamHeld(message=message, seconds=seconds):
            said = _BACK_AGAIN.given(seconds=writer.write_number(seconds, 2), message=message)
            line = _tell_line(_BEAM, said, writer)
        case Frozen(seconds=seconds):
            line = _tell_line(_FROZEN, _STANDS_STILL.given(seconds=writer.write_number(seconds, 0)), writer)
        case Elsewhere(position=position, factor=None):
            line = CaptureLine("", writer.say(_NO_TARGET.given(position=writer.write_position(position))))
        case Elsewhere(position=position, factor=float(factor)):
            said = _MISREAD.given(position=writer.write_position(position), why=_say_misread(factor, writer))
            line = _tell_line(_DISPLAY, said, writer)
        case _:
            line = _tell_asked_and_told(event, writer)
    return line


def _tell_asked_and_told(event: Event, writer: AxisWriter) -> CaptureLine | None:
    line: CaptureLine | None = None
    match event:
        case Unclear(expected=float(expected), candidates=((ListedVisit() as visit, _), *_)):
            why = _say_departure(event.position - expected, writer)
            line = _tell_line(_DOUBT, named(writer.name_visit(visit), why), writer)
        case Unclear(target=target, approach=approach):
            said = _MAY_BE.given(
                target=target, arrow=approach.arrow, candidates=_write_candidates(event, writer)
            )
            line = _tell_line(_WHERE, said, writer)
        case Presumed(visit=visit, share=share):
            said = _TAKEN_AS_LIKELY.given(
                visit=writer.name_visit(visit), share=writer.write_number(100 * share, 1)
            )
            line = _tell_line(_LIKELY, said, writer)
        case Placed(visit=visit):
            line = CaptureLine(
                writer.say(_PLACED), writer.name_visit(visit) if visit else writer.say(_NO_VISIT)
            )
        case Retake(first=first, last=last):
            said = (_TAKE_ONE if last == first else _TAKE_SEVERAL).given(
                first=first.number,
                last=last.number,
                visit=writer.name_visit(first),
                side=SIDES[first.approach],
            )
            line = _tell_line(_RETAKE, said, writer)
        case Skipped(visit=visit):
            line = _tell_line(_SKIPPED, _LEFT_OUT.given(visit=writer.name_visit(visit)), writer)
        case Commented(text=text):
            line = CaptureLine(writer.say(_COMMENT), text)
    return line


def say_halted(event: Event | None, writer: AxisWriter) -> str:
    """Return why nothing more is taken, and what that means for what was."""
    match event:
        case ZeroLost() | ScaleChanged():
            return writer.say(_say_failure(event, writer))
        case MovedBeforeDatum(position=position):
            return writer.say(_DATUM_UNKNOWN.given(position=writer.write_position(position)))
        case DatumMoved(visit=visit, difference=difference, void=void):
            moved = _HAS_MOVED.given(difference=writer.write_deviation(difference), number=visit.number)
            return writer.say(moved.given(void=_say_void(void, writer)))
        case Unclear():
            return writer.say(_say_question(event, writer))
        case TooSlow(spacing=spacing, largest=largest):
            times = {"spacing": _write_short(spacing, writer), "largest": _write_short(largest, writer)}
            return writer.say(_TOO_SELDOM.given(**times))
        case _:
            return writer.say(_READINGS_ENDED)


def _write_short(seconds: float, writer: AxisWriter) -> str:
    """Write a time with two digits that count."""
    return writer.write_general(float(f"{seconds:.2g}"))


def _say_failure(event: ZeroLost | ScaleChanged, writer: AxisWriter) -> Words:
    if isinstance(event, ZeroLost):
        return _ZERO_LOST.given(message=event.message or _LOST_ITS_ZERO, void=_say_void(event.void, writer))
    switched_to = _say_switched(event.factor, writer)
    if event.visit:
        return _SWITCHED_AGAIN.given(switched=switched_to, number=event.visit.number)
    return _SWITCHED.given(switched=switched_to)


def _say_question(event: Unclear, writer: AxisWriter) -> Words:
    visit = event.candidates[0][0]
    if event.expected is not None and visit is not None:
        departs = _say_departure(event.position - event.expected, writer)
        return _READ_DEPARTS.given(number=visit.number, visit=writer.name_visit(visit), departs=departs)
    return _LEAVES_OPEN.given(
        target=event.target,
        arrow=event.approach.arrow,
        position=writer.write_position(event.position),
        candidates=_write_candidates(event, writer),
    )


def _say_misread(factor: float, writer: AxisWriter) -> Words:
    """Say what a display does wrong whose readings come right by a factor, and the cure."""
    match factor:
        case -1.0:
            return _MIRRORED
        case _ if isclose(factor, _INCH):
            return _SHOWS_INCHES
        case _ if isclose(factor, 1 / _INCH):
            return _SHOWS_MILLIMETRES
        case _ if factor == DEGREES:
            return _SHOWS_DEGREES
        case _ if factor in {_THOUSAND, 1 / _THOUSAND}:
            return _OTHER_UNIT.given(factor=writer.write_general(factor))
        case _:
            return _OTHER_PATH.given(factor=writer.write_general(factor))


def _say_switched(factor: float, writer: AxisWriter) -> Words:
    """Say to which unit a display was switched, if its readings come right by a factor."""
    if isclose(factor, _INCH):
        return _TO_INCHES
    if isclose(factor, 1 / _INCH):
        return _TO_MILLIMETRES
    return _TO_ANOTHER.given(factor=writer.write_general(factor))


def _say_departure(difference: float, writer: AxisWriter) -> Words:
    return _DEPARTS.given(difference=writer.write_deviation(difference))


def _write_candidates(event: Unclear, writer: AxisWriter) -> str:
    """Write what an unclear stop may be: ``visit 12 (run 2) 60 %, visit 2 (run 1) 39 %, no visit 1 %``."""
    return ", ".join(
        writer.say(write_candidate(visit, writer.write_number(100 * share, 0)))
        for visit, share in event.candidates
        if share >= WORTH_NAMING
    )


def write_candidate(visit: ListedVisit | None, share: str) -> Words:
    """Say that a stop may be a visit, or none, with its probability in per cent."""
    if visit is None:
        return _NO_CANDIDATE.given(share=share)
    return _CANDIDATE.given(visit=visit.number, run=visit.run, share=share)


def _say_void(void: Sequence[ListedVisit], writer: AxisWriter) -> Words:
    first, last = void[0], void[-1]
    return (_SEVERAL_VOID if len(void) > 1 else _ONE_VOID).given(
        first=first.number,
        last=last.number,
        position=writer.write_position(first.position),
        arrow=first.approach.arrow,
        run=first.run,
    )


def list_what_to_do(progress: Progress, writer: AxisWriter, event: Event | None = None) -> list[str]:
    """Return what an operator does, step by step, before the capture goes on."""
    if progress.has_all and progress.datum is not None:
        return [writer.say(_LOOK_AGAIN.given(position=writer.write_position(progress.datum)))]
    visit = progress.next
    first, again = (_GO_ON, _GO_ON_AGAIN) if progress.taken else (_START, _START_AGAIN)
    step = (again if progress.attempt > 1 else first).given(
        visit=visit.number,
        position=writer.write_position(visit.position),
        side=SIDES[visit.approach],
        run=visit.run,
        attempt=progress.attempt,
    )
    steps = [writer.say(step)]
    if progress.zero is None and progress.datum is not None:
        steps.insert(0, writer.say(_STAND_STILL.given(position=writer.write_position(progress.datum))))
    elif progress.check:
        position, side = writer.write_position(progress.check.position), SIDES[progress.check.approach]
        steps.insert(0, writer.say(_COME_BACK.given(position=position, side=side)))
    elif isinstance(event, ZeroLost | DatumMoved):
        steps.insert(0, writer.say(_SET_ZERO))
    return steps
