"""Each check of a notifier passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from pydantic import Field

from refusals import failed_checks
from testing.sinning import make_sinner, make_tests
from zlmreport.plugin import AccessError, Options, Place, Words
from zlmreport.plugin.protocols import Message
from zlmreport.testing import NOTIFIER_CHECKS, NotifierTrial, check_notifier, notifiers

COUNTER = itertools.count()
SECRET = "swordfish"


class BoardOptions(Options):
    board: str = Field(description="Name of the board.")


class ExemplaryNotifier:
    """Pins each message to a board; there are two, and one reads what is on that in the north."""

    identifier = "exemplary-board"
    title: Any = Words(en="A board", de="Ein Brett")
    options: Any = BoardOptions

    def __init__(self) -> None:
        self.pinned: list[str] = []

    def receiver(self, options: Any) -> str:
        return str(options.board)

    def tell(self, message: Message, options: Any) -> None:
        if options.board not in {"north", "south"}:
            raise AccessError.at(Place(options.board), "there is no such board")
        if options.board == "north":
            self.pinned.append(f"{message.title}\n{message.text}")


def trial(notifier: Any) -> NotifierTrial:
    return NotifierTrial(
        {"board": "north"},
        lambda: "".join(notifier.pinned),
        {"board": "west"},
        (SECRET,),
        {"board": "south"},
    )


def pinned(change: Callable[[Message], str]) -> dict[str, Any]:
    """Return the sin of a notifier that tells something else."""

    def tell(self: Any, message: Message, options: Any) -> None:
        ExemplaryNotifier().tell(message, options)
        self.pinned.append(change(message))

    return {"tell": tell}


def careless(self: Any, message: Message, _options: Any) -> None:
    self.pinned.append(f"{message.title}\n{message.text}")


def raw(self: Any, message: Message, options: Any) -> None:
    if options.board != "north":
        raise OSError("no route to host")
    careless(self, message, options)


def loose_tongued(self: Any, message: Message, options: Any) -> None:
    if options.board != "north":
        raise AccessError.at(Place("board"), f"{SECRET} was not accepted")
    careless(self, message, options)


def leaves(*_: Any) -> None:
    raise SystemExit(0)


class Undescribed(Options):
    board: str = "north"


class Greedy(BoardOptions):
    tells: str = Field("", description="Taken.")


SINS: list[tuple[Any, dict[str, Any], str]] = [
    (notifiers.is_named, {"identifier": "A board"}, "must be lower-case ASCII"),
    (notifiers.is_named, {"title": "A board"}, "title must be Words"),
    (notifiers.options_are_described, {"options": Undescribed}, "'board' needs a description"),
    (notifiers.options_are_described, {"options": Greedy}, "tells belong to the core"),
    (notifiers.names_who_is_told, {"receiver": lambda *_: ""}, "not of one line"),
    (notifiers.names_who_is_told, {"receiver": lambda *_: None}, "str is expected"),
    (notifiers.names_who_is_told, {"receiver": lambda *_: "Ada\nBob"}, "not of one line"),
    (notifiers.names_who_is_told, {"receiver": lambda *_: f"{next(COUNTER)}"}, "another name each time"),
    (notifiers.names_who_is_told, {"receiver": lambda *_: f"https://{SECRET}@chat"}, "shows a secret"),
    (notifiers.tells_all_of_it_once, {"tell": lambda *_: None}, "nothing arrived, and tell raised nothing"),
    (notifiers.tells_all_of_it_once, pinned(lambda one: one.title), "did not arrive as it is"),
    (notifiers.tells_all_of_it_once, pinned(lambda one: one.text), "did not arrive as it is"),
    (
        notifiers.tells_all_of_it_once,
        pinned(lambda one: f"{one.title}\n{one.text}".encode("ascii", "ignore").decode()),
        "did not arrive as it is",
    ),
    (
        notifiers.tells_all_of_it_once,
        pinned(lambda one: f"{one.title}\n{one.text}".replace("<", "&lt;")),
        "did not arrive as it is",
    ),
    (
        notifiers.tells_all_of_it_once,
        pinned(lambda one: f"{one.title}\n{one.text}"[:200]),
        "lines of a message of",
    ),
    (notifiers.tells_whom_its_keys_name, {"receiver": lambda *_: "the board"}, "for other keys too"),
    (notifiers.tells_whom_its_keys_name, {"tell": careless}, "what somebody else is told arrives at"),
    (
        notifiers.tells_all_of_it_once,
        pinned(lambda one: f"{one.title}\n{one.text}" * 2),
        "the message arrived 2 times",
    ),
    (notifiers.tells_all_of_it_once, {"tell": leaves}, "raised SystemExit"),
    (notifiers.says_when_nobody_takes_it, {"tell": careless}, "did not raise AccessError"),
    (notifiers.says_when_nobody_takes_it, {"tell": raw}, "raised OSError: no route to host"),
    (notifiers.says_when_nobody_takes_it, {"tell": loose_tongued}, "shows a secret"),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    NOTIFIER_CHECKS, ExemplaryNotifier, SINS, lambda notifier, _: (trial(notifier),)
)


def test_a_trial_names_somebody_else() -> None:
    notifier = ExemplaryNotifier()
    with pytest.raises(AssertionError, match="say by which keys somebody else is told"):
        notifiers.tells_whom_its_keys_name(notifier, replace(trial(notifier), to_another=None))


def test_all_failures_are_reported_at_once() -> None:
    notifier = make_sinner(ExemplaryNotifier, {"title": "", "receiver": lambda *_: ""})
    assert failed_checks(check_notifier, notifier, trial(notifier)) == [
        "is_named",
        "names_who_is_told",
        "tells_whom_its_keys_name",
    ]
