"""What is asked of every kit: its exemplary plugin passes, each check finds its sins, and none has no sin."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

import pytest
from pydantic import Field

from refusals import failure
from zlmreport.plugin import Options, Words

Check: TypeAlias = Callable[..., None]
#: A check, what is changed of a sound plugin, and a part of the sentence with which the check fails.
Sin: TypeAlias = tuple[Check, dict[str, Any], str]


def make_sinner(sound: type, sin: dict[str, Any]) -> Any:
    """Return a plugin that does everything right but for what a sin changes."""
    return type("Sinner", (sound,), dict(sin))()


def make_tests(
    checks: Sequence[Check],
    sound: type,
    sins: Sequence[Sin],
    given: Callable[[Any, Path], tuple[Any, ...]],
    beside: Collection[Check] = (),
) -> tuple[Callable[..., None], Callable[..., None], Callable[[], None]]:
    """Return three tests of a kit: the sound plugin passes, each sin is named, every check has one.

    `given`: With what a check is called beside the plugin; from it and an empty folder.
    `beside`: Checks whose sin has a test of its own.
    """

    def name(value: object) -> str | None:
        return getattr(value, "__name__", None)

    @pytest.mark.parametrize("check", checks, ids=name)
    def passes(check: Check, tmp_path: Path) -> None:
        plugin = sound()
        check(plugin, *given(plugin, tmp_path))

    @pytest.mark.parametrize(("check", "sin", "sentence"), sins, ids=name)
    def finds_its_sin(check: Check, sin: dict[str, Any], sentence: str, tmp_path: Path) -> None:
        sinner = make_sinner(sound, sin)
        said = failure(check, sinner, *given(sinner, tmp_path))
        assert sentence in said, said

    def has_a_sin() -> None:
        without = set(checks) - {check for check, *_ in sins} - set(beside)
        assert not without, without

    return passes, finds_its_sin, has_a_sin


class _Undescribed(Options):
    speed: float = 1.0


class _Greedy(Options):
    program: str = Field("", description="Taken.")


class _Demanding(Options):
    speed: float = Field(description="Without a default.")


def list_sins_of_programs(kit: ModuleType, on_paper: Callable[[Callable[[str], str]], Any]) -> list[Sin]:
    """Return the sins that a program for any control can commit: of its name, its keys and its text.

    `kit`: The checks.
    `on_paper`: Returns a `write` whose program is changed by a function.
    """
    counter = itertools.count()

    def written(change: Callable[[str], str]) -> dict[str, Any]:
        return {"write": on_paper(change)}

    return [
        (kit.is_named, {"identifier": "Words!"}, "lower-case ASCII"),
        (kit.is_named, {"title": Words(en="", de="Titel")}, "title says nothing in 'en'"),
        (kit.is_named, {"suffix": "words"}, "must be like '.ngc'"),
        (kit.options_are_described, {"options": _Undescribed}, "job key 'speed' needs a description"),
        (kit.options_are_described, {"options": _Greedy}, "job keys program belong to the core"),
        (kit.options_are_described, {"options": _Demanding}, "job keys speed need a default"),
        (kit.is_plain_text, {"write": lambda *_: b"GO\n"}, "must return the text of a program"),
        (kit.is_plain_text, written(lambda text: f"SAY ä\n{text}"), "beyond ASCII"),
        (kit.is_plain_text, written(lambda text: f"SAY \x07\n{text}"), "control characters"),
        (kit.is_plain_text, written(str.rstrip), "the last line has no end"),
        (kit.is_plain_text, written(lambda text: f"SAY {'a' * 300}\n{text}"), "304 characters"),
        (
            kit.writes_the_same_again,
            written(lambda text: f"SAY {next(counter)}\n{text}"),
            "again gives another program",
        ),
    ]
