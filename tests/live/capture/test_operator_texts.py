"""What an operator reads: each event has its sentence, in every language."""

from __future__ import annotations

from dataclasses import replace

import pytest

from zlmreport.live.capture import events
from zlmreport.live.capture.display import DEGREES
from zlmreport.live.capture.operator_texts import AxisWriter, list_what_to_do, say_halted, tell_event
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.visits import ListedVisit
from zlmreport.plugin import Approach, Axis, AxisKind, Language
from zlmreport.plugin.instrument import BeamHeld, DatumHolds, DatumMoved, DatumTaken, ScaleChanged, ZeroLost

AXIS = Axis("X", AxisKind.LINEAR, 0.0, 0.1)
UP, DOWN = Approach.POSITIVE, Approach.NEGATIVE
FIRST, SECOND = (ListedVisit(number, number, 0.02 * number, UP, 1, 1, 0.0) for number in (1, 2))
MEAN = events.Mean(0.02, 2e-7, 20, 0, 1.0, 1.0, {})

LINES: tuple[events.Event, ...] = (
    DatumTaken(0.0, MEAN),
    DatumHolds(FIRST, 1e-6),
    events.Closed(1e-6, holds=True),
    events.Closed(1e-3, holds=False),
    events.NotChecked(1, UP),
    events.Recorded(FIRST, 1, 0.020001, MEAN),
    events.Passed(FIRST, 0.3),
    events.Passed(FIRST, 0.3, 1e-6),
    events.Missed(FIRST, 1),
    events.Repeated(FIRST),
    events.WrongDirection(FIRST, None),
    events.WrongDirection(FIRST, DOWN),
    events.NotNext(1, DOWN, SECOND),
    events.TrackLost(2.0),
    BeamHeld("", 1.0),
    events.Frozen(60.0),
    events.Elsewhere(0.031),
    *(events.Elsewhere(0.031, factor) for factor in (-1.0, 25.4, 1 / 25.4, DEGREES, 1000.0, 2.0)),
    events.Unclear(1, UP, ((FIRST, 0.7), (None, 0.3)), 0.021, MEAN),
    events.Unclear(1, UP, ((FIRST, 1.0),), 0.021, MEAN, 0.02),
    events.Presumed(FIRST, 0.99),
    events.Placed(FIRST),
    events.Placed(None),
    events.Retake(FIRST, FIRST),
    events.Retake(FIRST, SECOND),
    events.Skipped(FIRST),
)
HALTED: tuple[events.Event | None, ...] = (
    events.MovedBeforeDatum(0.0),
    DatumMoved(FIRST, 1e-3, (FIRST, SECOND)),
    ZeroLost("", (SECOND,)),
    *(ScaleChanged(factor, visit) for factor in (25.4, 1 / 25.4, 2.0) for visit in (None, FIRST)),
    events.TooSlow(2.0, 0.5),
    events.Unclear(1, UP, ((FIRST, 0.7), (None, 0.3)), 0.021, MEAN),
    events.Unclear(1, UP, ((FIRST, 1.0),), 0.021, MEAN, 0.02),
    None,
)
WRITERS = (AxisWriter(Language.ENGLISH, AXIS), AxisWriter(Language.GERMAN, AXIS))


@pytest.mark.parametrize("event", LINES, ids=repr)
def test_a_line_is_in_the_language_that_is_asked_for(event: events.Event) -> None:
    english, german = (tell_event(event, 4, each) for each in WRITERS)
    assert german.text != english.text


@pytest.mark.parametrize("event", HALTED, ids=repr)
def test_why_nothing_more_is_taken_is_in_the_language_that_is_asked_for(event: events.Event | None) -> None:
    english, german = (say_halted(event, each) for each in WRITERS)
    assert german != english


def test_after_the_last_visit_the_axis_goes_to_the_datum() -> None:
    progress = replace(Progress.begin((FIRST, SECOND), 0.0), taken=2, zero=0.0)
    (english,), (german,) = (list_what_to_do(progress, each) for each in WRITERS)
    assert english == "let the program go on to 0.000 mm, for the closing look at the datum"
    assert german != english


def test_a_terminal_reads_a_visit_with_its_numbers_in_columns() -> None:
    line = tell_event(events.Recorded(FIRST, 1, 0.020001, MEAN), 4, AxisWriter(Language.ENGLISH, AXIS))
    assert (line.name, line.text) == ("1/4", "run 1 ↑    20.000 mm      +1.00 µm  range 0.20 µm")
