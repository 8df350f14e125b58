"""Each check of a writer of part programs passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from refusals import failed_checks
from testing.exemplary_program import ExemplaryProgram, run_steps
from testing.sinning import list_sins_of_programs, make_sinner, make_tests
from zlmreport.plugin import AxisKind
from zlmreport.plugin.program import Motion
from zlmreport.testing import PART_PROGRAM_CHECKS, check_part_program, part_programs


def on_paper(change: Callable[[str], str]) -> Callable[..., str]:
    return lambda _, motion, options: change(ExemplaryProgram().write(motion, options))


def without_turning_points(text: str) -> str:
    return re.sub(r"GO .*\n(?=GO)", "", text)


def named(_self: object, motion: Motion, options: Any) -> str:
    return f"SAY {motion.axis.name}\n{ExemplaryProgram().write(motion, options)}"


def as_it_comes(_self: object, motion: Motion, _options: Any) -> str:
    return "SAY KIT-7\n" + "".join(
        f"GO {stop.position}\n" + ("REST 3.5\n" if stop.reading else "") for stop in motion.stops
    )


def in_millimetres(self: ExemplaryProgram, motion: Motion, options: Any) -> str:
    turned = motion.axis.kind is AxisKind.ROTARY
    stops = tuple(replace(stop, position=stop.position / (2 if turned else 1)) for stop in motion.stops)
    return ExemplaryProgram.write(self, replace(motion, stops=stops), options)


SINS = [
    *list_sins_of_programs(part_programs, on_paper),
    (
        part_programs.leads_to_every_reading_from_its_side,
        {"write": on_paper(without_turning_points)},
        "linear method: 17 stops; expected 21",
    ),
    (
        part_programs.leads_to_every_reading_from_its_side,
        {"write": on_paper(lambda text: text.replace("REST 3.5", "REST 3"))},
        "stop 2 is at -20.5 for 3 s; expected -20.5 for 3.5 s",
    ),
    (
        part_programs.moves_at_the_planned_feed,
        {"write": on_paper(lambda text: re.sub(r"FEED \S+\n", "", text))},
        "the motion to stop 1 has the feed nan; expected 1500 mm/min, stated before the first motion",
    ),
    (
        part_programs.moves_at_the_planned_feed,
        {"write": on_paper(lambda text: re.sub(r"(FEED \S+\n)(GO \S+\n)", r"\2\1", text))},
        "the motion to stop 1 has the feed nan",
    ),
    (
        part_programs.moves_at_the_planned_feed,
        {"write": on_paper(lambda text: text.replace("FEED 1500", "FEED 25"))},
        "the motion to stop 1 has the feed 25; expected 1500 mm/min",
    ),
    (part_programs.names_the_job, {"write": on_paper(lambda text: text.replace("KIT-7", ""))}, "KIT-7"),
    (part_programs.takes_no_name_for_a_command, {"write": named}, "the program cannot be run"),
    (part_programs.refuses_what_it_cannot_program, {"write": as_it_comes}, "eleven digits is not refused"),
    (
        part_programs.writes_rotary_axes,
        {"write": in_millimetres},
        "an axis C in degrees is not led as planned",
    ),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    PART_PROGRAM_CHECKS, ExemplaryProgram, SINS, lambda *_: (run_steps, {})
)


def test_an_interpreter_tells_the_feed() -> None:
    with pytest.raises(AssertionError, match=r"let the interpreter return \(position, seconds, feed\)"):
        part_programs.moves_at_the_planned_feed(
            ExemplaryProgram(), lambda text: [stop[:2] for stop in run_steps(text)], {}
        )


def test_all_failures_are_reported_at_once() -> None:
    quiet = on_paper(lambda text: text.replace("KIT-7", "").replace("REST", "SAY"))
    sinner = make_sinner(ExemplaryProgram, {"write": quiet})
    checks = failed_checks(check_part_program, sinner, run_steps)
    assert checks == ["leads_to_every_reading_from_its_side", "names_the_job"]
