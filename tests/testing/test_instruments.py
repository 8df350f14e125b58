"""Each check of a live instrument finds the sin it is there for; the installed ones pass them elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import replace
from itertools import islice
from types import SimpleNamespace
from typing import Any

import pytest
from pydantic import Field

from zlmreport.plugin import InputError, Options, Place, Words
from zlmreport.plugin.instrument import (
    Emulator,
    Fault,
    Framing,
    LiveConnection,
    LiveReading,
    Port,
    PortOptions,
    Scene,
    Trouble,
    streamed_readings,
)
from zlmreport.testing import InstrumentTraits, instruments


class _Emulator:
    """A gauge that says its position in nanometres, 100 times a second, and E while something is wrong.

    A colon begins each of its lines: what was cut off before it is not taken for its first digits.
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._sent = 0

    def unasked(self, time: float) -> bytes:
        lines = b""
        while (self._sent + 1) / 100 <= time:
            self._sent += 1
            at = self._sent / 100
            is_wrong = self._scene.troubles.has(Trouble.LOST_BEAM, at)
            lines += b":E\n" if is_wrong else b":%d\n" % round(self._scene.axis.position(at) * 1e9)
        return lines

    def answer(self, data: bytes, time: float) -> bytes:  # noqa: ARG002
        return b""


class _Gauge:
    """A sound instrument."""

    identifier = "exemplary-gauge"
    title = Words(en="An exemplary gauge", de="Ein beispielhafter Taster")
    options: type[Options] = PortOptions
    per_metre = 1e9
    fault = Fault.BEAM_LOST
    follows_sign = True
    takes_cut = False

    def open(self, options: PortOptions) -> Any:
        port = Port(options.port, Framing(), options.timeout)
        factor = options.factor if self.follows_sign else 1.0
        decoder = SimpleNamespace(understood=0, feed=lambda data, now: self._readings(data, now, factor))
        patience: Any = SimpleNamespace(hear=lambda *_: None, check=lambda *_: None)

        def readings() -> Iterator[LiveReading]:
            return streamed_readings(port, decoder, patience, 0.05)

        return LiveConnection(port, readings)

    def emulator(self, scene: Scene) -> Emulator:
        return _Emulator(scene)

    def _readings(self, data: bytes, now: float, factor: float) -> list[LiveReading]:
        found = []
        for sent in data.split(b"\n")[: None if self.takes_cut else -1]:
            line = sent.rpartition(b":")[2]
            if line == b"E":
                found.append(LiveReading(1.0, now, self.fault, message="lost" if self.fault else ""))
            elif line.lstrip(b"-").isdigit():
                found.append(LiveReading(int(line) / self.per_metre * factor, now))
        return found


TRAITS = InstrumentTraits(has_check_sum=False, tells_lost_beam=True)


class _RequiringOptions(PortOptions):
    password: str = Field(description="Required.")


class _Portless(Options):
    """An instrument that nobody can plug in."""


def _sin(**members: Any) -> Any:
    return type("Sinful", (_Gauge,), members)()


def _careless(_self: object, _options: PortOptions) -> Any:
    raise InputError.at(Place("somewhere"), "no")


def _quiet(_self: object, _options: PortOptions) -> Any:
    return nullcontext(SimpleNamespace(readings=lambda: iter(())))


@pytest.mark.parametrize(
    "check",
    [
        instruments.is_named,
        instruments.options_are_described,
        instruments.follows_the_axis,
        instruments.no_cut_answer_is_usable,
        instruments.no_garbled_answer_is_usable,
        instruments.tells_of_a_lost_beam,
    ],
)
def test_a_sound_instrument_passes(check: Any) -> None:
    check(_Gauge(), TRAITS)


@pytest.mark.parametrize(
    ("check", "sinful", "sentence"),
    [
        (instruments.is_named, _sin(identifier="A Gauge"), "identifier 'A Gauge' must be lower-case"),
        (instruments.options_are_described, _sin(options=_Portless), "there is no key 'port'"),
        (instruments.options_are_described, _sin(options=_RequiringOptions), "keys password need defaults"),
        (instruments.follows_the_axis, _sin(per_metre=1e6), r"SI is expected"),
        (instruments.sign_turns_it_round, _sin(follows_sign=False), "with sign '-' readings go by"),
        (instruments.no_wrong_reading_is_usable, _sin(fault=Fault(0)), "the axis rests at 0, and 1.0 m"),
        (instruments.sign_turns_it_round, _sin(per_metre=-1e9), r"with sign '\+' readings go by"),
        (instruments.no_cut_answer_is_usable, _sin(takes_cut=True), "m is called usable"),
        (instruments.tells_of_a_lost_beam, _sin(fault=Fault.UNREADABLE), "no reading says so"),
        (instruments.refuses_silence, _sin(open=lambda *_: sys.exit(0)), "raised SystemExit: 0"),
        (instruments.refuses_silence, _sin(open=_careless), "an AccessError is expected"),
        *(
            (check, _sin(open=_quiet), "the readings end without a word; an AccessError")
            for check in (
                instruments.notices_the_cable,
                instruments.refuses_silence,
                instruments.refuses_another_device,
                instruments.refuses_a_port_that_is_not_there,
            )
        ),
    ],
)
def test_a_sin_is_found(check: Any, sinful: Any, sentence: str) -> None:
    with pytest.raises(AssertionError, match=sentence):
        check(sinful, TRAITS)


def test_a_check_sum_that_nobody_looks_at_is_found() -> None:
    with pytest.raises(AssertionError, match="a digit is another, and the check sum is not"):
        instruments.no_garbled_answer_is_usable(_Gauge(), replace(TRAITS, has_check_sum=True))


def test_the_author_says_what_the_manual_says() -> None:
    for check in (instruments.no_garbled_answer_is_usable, instruments.tells_of_a_lost_beam):
        with pytest.raises(AssertionError, match="say what its manual says"):
            check(_Gauge())


def test_an_instrument_that_begins_late_sees_all_that_goes_wrong() -> None:
    def begin_late(gauge: Any, options: PortOptions) -> Any:
        time.sleep(1.5)
        return _Gauge.open(gauge, options)

    instruments.tells_of_a_lost_beam(_sin(open=begin_late), TRAITS)


def test_an_instrument_that_knows_no_beam_need_not_tell_of_it() -> None:
    traits = replace(TRAITS, tells_lost_beam=False)
    instruments.tells_of_a_lost_beam(_sin(fault=Fault(0)), traits)


def test_an_instrument_that_waits_for_ever_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(instruments, "_PATIENCE", 0.2)
    endless = SimpleNamespace(
        __enter__=None, readings=lambda: islice(iter(lambda: LiveReading(0.0, 0.0), None), 10**9)
    )

    class _Open:
        def __enter__(self) -> Any:
            return endless

        def __exit__(self, *_: object) -> None: ...

    with pytest.raises(AssertionError, match="it still reads after"):
        instruments.refuses_silence(_sin(open=lambda *_: _Open()))
