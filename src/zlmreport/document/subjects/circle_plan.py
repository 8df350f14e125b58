"""The path of a circular test before it is run, as people read it, and as plain values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from zlmreport.document.blocks import Align, Block, Column, Paragraph, RowGroup, Section, Table
from zlmreport.document.subjects.plan_values import SCHEMA
from zlmreport.job.job import Job
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_general_number, write_stated_number
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.model.planning.circle_path import SENSES, CirclePath

_MINUTE = 60.0
_DIGITS = 3
_SIZE_OF_ONE = Words("1 turn of radius {radius} mm")
_SIZE = Words("{count} turns of radius {radius} mm")
_PATH = Words("Path")
_ROUND = Words(
    "evaluated from {first} to {last}°, +{from_axis} towards +{to_axis}, counter-clockwise and back clockwise"
)
_RUNS = Words("{runs} in each sense{assumed}")
_ASSUMED = Words(" (assumed)")
_BESIDE = Words(
    "{arc}° of the circle before and behind it; the tool comes up from {run_up} mm outside, and rests "
    "{rest} s between two turns"
)
_SLOWER = Words(
    "a control that allows less acceleration runs slower than it is told; the readings then tell their "
    "own time"
)
_SOURCE = Words("source: {{plugin: circle-csv, feed_in: {arc}, feed_out: {arc}}}")


def say_size_of_circle(path: CirclePath) -> Words:
    """Return how many turns a test has, and of which radius."""
    turns = len(path.turns)
    return (_SIZE if turns != 1 else _SIZE_OF_ONE).given(count=turns, radius=path.radius)


def lay_out_circle_plan(job: Job, paths: Sequence[CirclePath], language: Language) -> tuple[Section, ...]:
    """Return what is said of the path of a circular test: ``path``, ``feeds``, ``reading``.

    `paths`: One for each feed.
    """

    def say(words: Words) -> str:
        return words.in_language(language)

    arc = write_stated_number(paths[0].turns[0].arc)
    return (
        Section("path", say(_PATH), tuple(Paragraph(say(words)) for words in _describe_path(job, paths[0]))),
        Section("feeds", say(Words("Feeds")), tuple(_lay_out_feeds(paths, language))),
        Section("reading", say(Words("To read the circle")), (Paragraph(say(_SOURCE.given(arc=arc))),)),
    )


def _describe_path(job: Job, path: CirclePath) -> Iterator[Words]:
    turn = path.turns[0]
    first, last = sorted((turn.first, turn.last))
    from_axis, to_axis = path.circle.axes
    yield _ROUND.given(first=first, last=last, from_axis=from_axis, to_axis=to_axis)
    runs = len({each.run for each in path.turns})
    yield _RUNS.given(runs=runs, assumed="" if job.keys.plan.runs else _ASSUMED)
    yield _BESIDE.given(arc=turn.arc, run_up=path.run_up, rest=path.rest)


def _lay_out_feeds(paths: Sequence[CirclePath], language: Language) -> Iterator[Block]:
    columns = (
        Column("", "mm/min", Align.RIGHT),
        Column(Words("turn").in_language(language), "s", Align.RIGHT),
        Column(Words("test").in_language(language), "min", Align.RIGHT),
        Column(Words("acceleration").in_language(language), "m/s²", Align.RIGHT),
    )
    sign = language.decimal_sign
    rows = tuple(
        tuple(
            write_general_number(float(f"{value:.{_DIGITS}g}"), sign)
            for value in (path.feed, _compute_time_of_turn(path), path.duration / _MINUTE, path.acceleration)
        )
        for path in paths
    )
    yield Table("", columns, (RowGroup(rows),))
    yield Paragraph(_SLOWER.in_language(language))


def _compute_time_of_turn(path: CirclePath) -> float:
    """Return the time of what is evaluated of a turn, s."""
    turn = path.turns[0]
    return math.radians(abs(turn.last - turn.first)) * path.radius / path.feed * _MINUTE


def collect_circle_plan(job: Job, paths: Sequence[CirclePath], written: Sequence[Path]) -> dict[str, Any]:
    """Return the path of a circular test as plain values for JSON; positions in mm, angles in degrees."""
    path = paths[0]
    return {
        "schema": SCHEMA,
        "certificate": {"number": job.keys.certificate.number},
        "circle": {
            "plane": path.circle.plane,
            "radius": path.radius,
            "centre": [MILLIMETRE.from_si(each) for each in path.circle.centre],
        },
        "units": {"position": "mm", "angle": "deg", "time": "s"},
        "run_up": path.run_up,
        "rest": path.rest,
        "turns": [
            {
                "sense": SENSES[turn.sense],
                "run": turn.run,
                "first": turn.first,
                "last": turn.last,
                "arc": turn.arc,
            }
            for turn in path.turns
        ],
        "feeds": [
            {
                "feed_per_minute": each.feed,
                "duration": each.duration,
                "acceleration": each.acceleration,
            }
            for each in paths
        ],
        "assumed": [] if job.keys.plan.runs else ["plan.runs"],
        "files": [str(each) for each in written],
    }
