"""Of every kit: no plugin ends it or keeps it for ever, and what it says is a sentence."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from importlib import import_module
from types import MappingProxyType
from typing import Any

import pytest

from refusals import failure
from testing.exemplary import ExemplaryStandard
from zlmreport.plugin import Options, Words
from zlmreport.plugin.extension import Command, CommandOption, Extension
from zlmreport.plugin.kinds import KINDS, Kind
from zlmreport.testing import check_extension, check_standard, expectations, extensions as kit


def _sinful(**members: Any) -> Any:
    return type("Sinful", (ExemplaryStandard,), members)()


def test_exit_in_one_check_ends_no_other() -> None:
    def leave(*_: Any) -> Any:
        sys.exit(0)

    with pytest.raises(AssertionError) as failure:
        check_standard(_sinful(requirements=leave, designation=""))
    lines = str(failure.value).splitlines()
    assert lines[0].startswith("is_named: exemplary:1: designation")
    assert any(line.startswith("figures_of_any_test: exemplary:1: raised SystemExit: 0") for line in lines)
    assert "Traceback" not in str(failure.value)


def test_what_several_checks_find_is_said_once() -> None:
    def raises(_self: object, *_: object) -> None:
        raise ValueError("no")

    found = failure(check_standard, type("Sinner", (ExemplaryStandard,), {"arithmetic": raises})())
    sentences = [line.partition(": ")[2] for line in found.splitlines()]
    told = [each for each in sentences if not each.startswith("as ")]
    assert len(told) == len(set(told)) < len(sentences)


def test_raw_error_becomes_a_sentence_with_its_line() -> None:
    with pytest.raises(AssertionError, match=r"exemplary:1: raised KeyError: 'A' \(test_kits.py, line \d+\)"):
        check_standard(_sinful(figures=property(lambda _: {}["A"])))


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_what_is_missing_is_told_by_the_door_that_an_author_imports(kind: Kind[Any]) -> None:
    told = failure(expectations.expect_members, object(), kind)
    door, _, name = told.partition("(see ")[2].removesuffix(")").rpartition(".")
    assert getattr(import_module(door), name) is kind.protocol


def test_check_that_does_not_come_back_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expectations, "PATIENCE", 0.05)
    released = threading.Event()

    @expectations.check
    def waits(_standard: object) -> None:
        released.wait()

    with pytest.raises(AssertionError, match=r"exemplary:1: does not come back within 0.05 s"):
        waits(ExemplaryStandard())
    released.set()


UNDESCRIBED = CommandOption("x", "X", "", str)


class Tracer(Extension):
    """A group without keys."""

    identifier = "tracer"
    title = Words(en="Tracer", de="Laser-Tracer")
    description = "A tracer."
    example = MappingProxyType({})
    options = Options


@pytest.mark.parametrize(
    ("check", "sin", "message"),
    [
        (kit.is_named, {"identifier": "My-Tracer"}, "the identifier is a job key"),
        (kit.is_named, {"identifier": "axis"}, "the job has this key itself"),
        (kit.keys_are_described, {"example": {"speed": 3}}, "unknown keys speed"),
        (kit.lists_part_programs_where_it_says, {"programs": ("path",)}, "is no list of part programs"),
        (
            kit.commands_are_described,
            {"commands": (Command("trace", "Trace.", "", (UNDESCRIBED,), lambda *_: 0),)},
            "--x has no help",
        ),
    ],
)
def test_a_sin_is_told(check: Callable[..., None], sin: dict[str, Any], message: str) -> None:
    check_extension(Tracer())
    sinner = type("Sinner", (Tracer,), sin)()
    assert message in failure(check, sinner)
