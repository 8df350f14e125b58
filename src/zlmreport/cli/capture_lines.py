"""What an operator reads while a test is captured: a line for what happened, and what to do next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isclose

from zlmreport.language.formatting import MINUS, write_fixed_number
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
SIDES = {Approach.POSITIVE: "from below", Approach.NEGATIVE: "from above"}
#: The least probability of an explanation that is named.
_WORTH_NAMING = 0.005
_DRIFT_HELP = "let the axis and the instrument settle, or look what moves the optics"
_FROZEN_HELP = "if the program runs on, the display stands still: look at its hold key and its line"
_SECONDS_A_MINUTE, _MINUTES_AN_HOUR = 60, 60


@dataclass(frozen=True, slots=True)
class AxisWriter:
    """Writes positions and deviations of an axis as the terminal shows them."""

    axis: Axis

    def position(self, value: float, decimals: int = 3) -> str:
        """Write a position in mm or °."""
        unit = self.axis.position_unit
        return with_unit(write_fixed_number(unit.from_si(value), decimals), unit.symbol)

    def deviation(self, value: float) -> str:
        """Write a deviation in µm or ″, with its sign."""
        number = self.fine(value)
        return number if number.startswith(MINUS) else f"+{number}"

    def fine(self, value: float) -> str:
        """Write a small length in µm or ″."""
        unit = self.axis.deviation_unit
        return with_unit(write_fixed_number(unit.from_si(value), 2), unit.symbol)

    def visit(self, visit: ListedVisit) -> str:
        """Name a visit: ``run 2 ↑  150.000 mm``."""
        return f"run {visit.run} {visit.approach.arrow} {self.position(visit.position):>12}"


def tell_event(event: Event, visits: int, writer: AxisWriter) -> str:
    """Return what an operator reads of an event; nothing for those that only a display shows."""
    match event:
        case DatumTaken(position=position):
            return f"datum    the reading is taken for {writer.position(position)}"
        case DatumHolds(visit=visit, difference=difference):
            return f"datum    holds: {writer.deviation(difference)} against visit {visit.number}"
        case Closed(difference=difference, holds=holds):
            slipped = "" if holds else ": it slipped, and what was read since it was taken is marked"
            return f"closure  {writer.deviation(difference)} at the datum{slipped}"
        case NotChecked(target=target, approach=approach):
            return f"datum    target {target} {approach.arrow} was not read before: nothing is taken"
        case Recorded(visit=visit, mean=mean):
            number = f"{visit.number:>{len(str(visits))}}/{visits}"
            deviation = writer.deviation(event.deviation)
            return f"{number:8} {writer.visit(visit)}  {deviation:>12}  range {writer.fine(mean.range)}"
        case _:
            return _tell_out_of_order(event, writer)


def _tell_out_of_order(event: Event, writer: AxisWriter) -> str:
    line = ""
    match event:
        case Passed(visit=visit, seconds=seconds, drift=drift):
            line = f"passed   {writer.visit(visit)}: nothing taken, it was there for {seconds:.1f} s"
            if drift is not None:
                line += f", drifting {writer.deviation(drift)} a second: {_DRIFT_HELP}"
        case Missed(visit=visit):
            line = f"MISSED   {writer.visit(visit)}: the axis stands at a later one"
        case Repeated(visit=visit):
            line = f"again    {writer.visit(visit)}: the axis has gone on from its reading, which stays"
        case WrongDirection(visit=visit, approach=approach):
            came = f"it came {SIDES[approach]}" if approach else "no motion towards it was seen"
            line = f"WRONG    {writer.visit(visit)}: {came}; let it come {SIDES[visit.approach]}"
        case NotNext(target=target, approach=approach, visit=visit):
            line = f"OTHER    target {target} {approach.arrow} is not next; next is {writer.visit(visit)}"
        case _:
            line = _tell_out_of_sight(event, writer)
    return line


def _tell_out_of_sight(event: Event, writer: AxisWriter) -> str:
    line = ""
    match event:
        case TrackLost(silence=silence):
            line = f"SILENT   no sound reading came for {silence:.1f} s; visits may have gone unseen"
        case BeamHeld(message=message, seconds=seconds):
            line = f"beam     back after {seconds:.2f} s, and the display shows what it showed: {message}"
        case Frozen(seconds=seconds):
            line = f"FROZEN   the display has shown the same for {seconds:.0f} s: {_FROZEN_HELP}"
        case Elsewhere(position=position, factor=None):
            line = f"no target at {writer.position(position)}, where it stands; is the datum right?"
        case Elsewhere(position=position, factor=float(factor)):
            line = f"DISPLAY  {writer.position(position)} is no target, {tell_misread(factor)}"
        case _:
            line = _tell_asked_and_told(event, writer)
    return line


def _tell_asked_and_told(event: Event, writer: AxisWriter) -> str:
    line = ""
    match event:
        case Unclear(expected=float(expected), candidates=((ListedVisit() as visit, _), *_)):
            line = f"DOUBT    {writer.visit(visit)}: {_tell_departure(event.position - expected, writer)}"
        case Unclear(target=target, approach=approach):
            line = f"WHERE?   target {target} {approach.arrow}: {write_candidates(event)}"
        case Presumed(visit=visit, share=share):
            line = f"likely   {writer.visit(visit)}: {100 * share:.1f} % sure, and taken for it"
        case Placed(visit=visit):
            line = f"placed   {writer.visit(visit) if visit else 'no visit'}"
        case Retake(first=first, last=last):
            until = "" if last == first else f" to {last.number}"
            came = f"{writer.visit(first)} {SIDES[first.approach]}"
            line = f"RETAKE   visit {first.number}{until}: let the axis come to {came}"
        case Skipped(visit=visit):
            line = f"skipped  {writer.visit(visit)}: left out, as you said"
        case Commented(text=text):
            line = f"comment  {text}"
    return line


def tell_halted(event: Event | None, writer: AxisWriter) -> str:
    """Return why nothing more is taken, and what that means for what was."""
    match event:
        case ZeroLost() | ScaleChanged():
            return _tell_failure(event, writer)
        case MovedBeforeDatum(position=position):
            return (
                f"the axis moved before the reading at {writer.position(position)} was taken for its datum, "
                "and where it stands now is not known: stop the program"
            )
        case DatumMoved(visit=visit, difference=difference, void=void):
            moved = (
                f"the datum has moved by {writer.deviation(difference)} since visit {visit.number} was read"
            )
            return f"{moved}. {_tell_void(void, writer)}"
        case Unclear():
            return _tell_question(event, writer)
        case TooSlow(spacing=spacing, largest=largest):
            return (
                f"readings come every {spacing:.2g} s, and more than {largest:.2g} s apart the axis could "
                "turn round unseen: let the instrument send more often (its key rate), or state a larger "
                "plan.overrun, a lower measurement.feed or a longer measurement.source.dwell"
            )
        case _:
            return "the readings ended"


def _tell_failure(event: ZeroLost | ScaleChanged, writer: AxisWriter) -> str:
    if isinstance(event, ZeroLost):
        return f"{event.message or 'the instrument lost its zero'}. {_tell_void(event.void, writer)}"
    again = (
        f"; visit {event.visit.number} is taken again, for it may have been read so" if event.visit else ""
    )
    return (
        f"{tell_switched(event.factor)}, and nothing of it is taken{again}. Set it back: what was read stays"
    )


def _tell_question(event: Unclear, writer: AxisWriter) -> str:
    visit = event.candidates[0][0]
    if event.expected is not None and visit is not None:
        departs = _tell_departure(event.position - event.expected, writer)
        return f"the reading at visit {visit.number} ({writer.visit(visit)}) {departs}"
    return (
        f"the axis stands at target {event.target} {event.approach.arrow}, {writer.position(event.position)},"
        f" and what it did before leaves open which visit that is: {write_candidates(event)}"
    )


def tell_misread(factor: float) -> str:
    """Say what a display does wrong whose readings come right by a factor, and the cure."""
    inch, thousand = 25.4, 1000.0
    match factor:
        case -1.0:
            return "but its mirror image is: the display counts the other way; turn the instrument's key sign"
        case _ if isclose(factor, inch):
            return "but 25.4 times it is: the display shows inches; set it to millimetres"
        case _ if isclose(factor, 1 / inch):
            return "but a 25.4th of it is: the display shows millimetres as inches; set it to inches"
        case _ if factor in {thousand, 1 / thousand}:
            return f"but {factor:g} times it is: the display's unit is another one; set it, or the key scale"
        case _:
            return f"but {factor:g} times it is: the optics' path is counted otherwise; set the key scale"


def tell_switched(factor: float) -> str:
    """Say to which unit a display was switched, if its readings come right by a factor."""
    inch = 25.4
    if isclose(factor, inch):
        return "the display was switched to inches"
    if isclose(factor, 1 / inch):
        return "the display was switched from inches to millimetres"
    return f"the display was switched to another unit: {factor:g} times what it shows is right"


def _tell_departure(difference: float, writer: AxisWriter) -> str:
    return (
        f"departs by {writer.deviation(difference)} from what was read before and from the plan, more than "
        "an axis does: a stop short of its target, a datum that slipped, or a display that fails"
    )


def write_candidates(event: Unclear) -> str:
    """Write what an unclear stop may be: ``visit 12 (run 2) 60 %, visit 2 (run 1) 39 %, no visit 1 %``."""
    return ", ".join(
        f"{f'visit {visit.number} (run {visit.run})' if visit else 'no visit'} {share:.0%}".replace("%", " %")
        for visit, share in event.candidates
        if share >= _WORTH_NAMING
    )


def _tell_void(void: Sequence[ListedVisit], writer: AxisWriter) -> str:
    first, last = void[0], void[-1]
    visits = f"visits {first.number} to {last.number} are" if len(void) > 1 else f"visit {first.number} is"
    return (
        f"The datum is gone: {visits} void, from {writer.position(first.position)} {first.approach.arrow} of "
        f"run {first.run} on. What was taken before stays"
    )


def list_what_to_do(progress: Progress, writer: AxisWriter, event: Event | None = None) -> list[str]:
    """Return what an operator does, step by step, before the capture goes on."""
    visit = progress.next
    attempt = f", attempt {progress.attempt}" if progress.attempt > 1 else ""
    begin = "go on with" if progress.taken else "start"
    where = f"{writer.position(visit.position)} {SIDES[visit.approach]}, run {visit.run}{attempt}"
    steps = [f"{begin} the program at visit {visit.number}: {where}"]
    if progress.zero is None and progress.datum is not None:
        steps.insert(0, f"let the axis stand still at {writer.position(progress.datum)}, for the datum")
    elif progress.must_check:
        last = max((read.visit for read in progress.read.values()), key=lambda visit: visit.number)
        back = f"{writer.position(last.position)} {SIDES[last.approach]}"
        steps.insert(0, f"let the axis come once more to {back}, to check the datum")
    elif isinstance(event, ZeroLost | DatumMoved):
        steps.insert(0, "set the instrument's zero as it was when the capture began")
    return steps


def write_duration(seconds: float) -> str:
    """Write how long something takes.

    >>> duration(42), duration(150), duration(5000)
    ('less than a minute', 'about 2 min', 'about 1 h 23 min')
    """
    minutes = round(seconds / _SECONDS_A_MINUTE)
    if minutes < 1:
        return "less than a minute"
    hours, minutes = divmod(minutes, _MINUTES_AN_HOUR)
    return f"about {hours} h {minutes} min" if hours else f"about {minutes} min"
