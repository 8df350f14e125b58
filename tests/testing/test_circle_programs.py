"""Each check of a writer of circles passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import pytest

from refusals import failed_checks
from testing.exemplary_program import ExemplaryProgram
from testing.sinning import make_sinner, make_tests
from zlmreport.plugin import InputError, Place
from zlmreport.plugin.program import CirclePath, circle_heading
from zlmreport.testing import CIRCLE_PROGRAM_CHECKS, CircleMove, check_circle_program, circle_programs

COUNTER = itertools.count()


class ExemplaryCircles(ExemplaryProgram):
    """A line for each move: LINE or the sense of an arc, its end, and of an arc its centre."""

    def write_circle(self, path: CirclePath, options: Any) -> str:
        lines = [*(f"SAY {text}" for text in circle_heading(path, options)), f"FEED {path.feed:g}"]
        for block in path.blocks(options.decimals):
            x, y = block.end
            lines.append(f"{int(block.sense)} {x:g} {y:g} 0 0" if block.sense else f"LINE {x:g} {y:g}")
        return "".join(f"{line}\n" for line in lines)


def run_moves(text: str) -> list[CircleMove]:
    """Run a program of these words."""
    moves, feed = [], 0.0
    for line in text.splitlines():
        word, _, rest = line.partition(" ")
        if word == "FEED":
            feed = float(rest)
        elif word != "SAY":
            x, y, *centre = map(float, rest.split())
            moves.append(
                CircleMove((x, y), feed, 0 if word == "LINE" else int(word), (*centre, 0.0, 0.0)[:2])
            )
    return moves


def on_paper(change: Callable[[str], str]) -> dict[str, Any]:
    """Return the sin of a writer whose text is another one."""
    return {"write_circle": lambda _, path, options: change(ExemplaryCircles().write_circle(path, options))}


def rounding(_self: object, path: CirclePath, options: Any) -> str:
    return ExemplaryCircles().write_circle(path, options.model_copy(update={"decimals": 9}))


def elsewhere(_self: object, path: CirclePath, options: Any) -> str:
    try:
        return ExemplaryCircles().write_circle(path, options)
    except InputError as error:
        raise InputError.at(Place("elsewhere"), "no") from error


def named(_self: object, path: CirclePath, options: Any) -> str:
    begin = "FEED 1500\nLINE 9 9\n" if "G0" in path.number else ""
    return f"{begin}{ExemplaryCircles().write_circle(path, options)}"


TURNS, FEED, TEXT, POINTS = (
    circle_programs.runs_every_turn_in_its_sense,
    circle_programs.keeps_to_circle_and_feed,
    circle_programs.writes_circles_as_plain_text,
    circle_programs.refuses_points_off_the_circle,
)
SINS = [
    (
        TURNS,
        on_paper(lambda text: text.replace("\n-1 ", "\n+1 ")),
        "turn 2 goes over +720.00°; expected -720.00°",
    ),
    (
        TURNS,
        on_paper(lambda text: text.replace("LINE -102 0\n", "LINE -100 0\n", 1)),
        "2 mm outside the circle",
    ),
    (TURNS, on_paper(lambda text: text[: text.rindex("LINE")]), "the last turn does not leave the circle"),
    (TURNS, on_paper(lambda text: text[: text.rindex("LINE -100")]), "turns: 3; expected 4"),
    (FEED, on_paper(lambda text: text.replace("FEED 1500", "FEED 25")), "a move at 25 mm/min; expected 1500"),
    (FEED, on_paper(lambda text: text.replace(" 0 0\n", " 0 1\n")), "expected 100 mm about the zero"),
    (TEXT, on_paper(lambda text: f"SAY ä\n{text}"), "beyond ASCII"),
    (TEXT, on_paper(lambda text: text.replace("KIT-7", "")), "does not name the job, KIT-7"),
    (TEXT, on_paper(lambda text: f"SAY {next(COUNTER)}\n{text}"), "again gives another program"),
    (TEXT, {"write_circle": named}, "moves otherwise"),
    (POINTS, {"write_circle": rounding}, "points off the circle are not refused"),
    (POINTS, {"write_circle": elsewhere}, "refused elsewhere than at path.place"),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    CIRCLE_PROGRAM_CHECKS, ExemplaryCircles, SINS, lambda *_: (run_moves, {})
)


def test_all_failures_are_reported_at_once() -> None:
    sinner = make_sinner(ExemplaryCircles, on_paper(lambda text: text.replace("FEED 1500", "FEED 0")))
    assert failed_checks(check_circle_program, sinner, run_moves) == ["keeps_to_circle_and_feed"]
    with pytest.raises(AssertionError, match="has no write_circle"):
        check_circle_program(ExemplaryProgram(), run_moves)
