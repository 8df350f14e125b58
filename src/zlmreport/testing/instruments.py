"""What every live instrument must do, tried against its own emulator.

The emulator is put on a socket of this computer, so no hardware is needed; a check takes some seconds.
"""

from __future__ import annotations

import re
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from typing import Any

from zlmreport.errors import AccessError, ZlmreportError
from zlmreport.live.emulation.channels import LocalSocket, serve
from zlmreport.live.emulation.emulator import MovingAxis, Scene
from zlmreport.live.emulation.troubles import Planned, Trouble, Troubles
from zlmreport.live.ports.reading import LiveReading
from zlmreport.plugin.kinds import INSTRUMENT
from zlmreport.plugin.protocols import Instrument
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    expect_options,
    list_checks_of,
    run_all,
)

#: By how much emulated time is faster than that of the checks, and how much of this passes at most between
#: two looks at it, s: in more, the computer did something else, and the emulated instrument waits.
_HASTE, _LONGEST_LOOK = 5.0, 0.05
#: How far the axis of the checks goes, m, and how long it rests, emulated s.
_STEP, _DWELL = 0.01, 2.0
#: Where an axis rests whose readings have many digits, m, and how fast it gets there, m/s.
_FAR, _AT_ONCE = 0.1234567, 1e3
#: How many sendings arrive whole before the first is cut off.
_SOUND_FIRST = 12
#: No instrument that calibrates an axis resolves less, m.
_COARSEST = 1e-6
#: How long after its first reading something goes wrong, and how long a check watches, emulated s.
_TROUBLE_AFTER, _WATCHED = 1.0, 8.0
#: When the cable is pulled, emulated s from the start; how long an instrument may take to notice it, s.
_UNPLUGGED_AT, _PATIENCE = 6.0, 20.0


@dataclass(frozen=True, slots=True)
class InstrumentTraits:
    """What the author of an instrument's plugin knows of its protocol, from its manual.

    Attributes
    ----------
    has_check_sum
        Whether what it sends carries a check by which a wrong digit is noticed. Without one nobody can tell
        a garbled digit from another reading.
    tells_lost_beam
        Whether it says that its signal was lost, so that its count is void from then on.
    """

    has_check_sum: bool
    tells_lost_beam: bool


@check
def is_named(instrument: Instrument, *_: Any) -> None:
    """Check that it has an identifier that can be typed, and a title in every language."""
    expect_named(instrument, INSTRUMENT)


@check
def options_are_described(instrument: Instrument, *_: Any) -> None:
    """Check that its keys are described, that a port is one of them, and that nothing else is required."""
    expect_options(instrument, INSTRUMENT)
    fields = instrument.options.model_fields
    expect("port" in fields, f"{instrument.identifier}: there is no key 'port'")
    required = sorted(name for name, field in fields.items() if field.is_required() and name != "port")
    expect(not required, f"{instrument.identifier}: keys {', '.join(required)} need defaults")


@check
def follows_the_axis(instrument: Instrument, *_: Any) -> None:
    """Check that readings go where the axis goes, and are sound, in order and stamped with their arrival."""
    name = instrument.identifier
    with _run_emulated(instrument) as stage:
        readings = _watch(instrument, stage)
    faulty = [reading for reading in readings if not reading.is_usable]
    expect(readings, f"{name}: there were no readings")
    expect(not faulty, f"{name}: nothing is wrong, and yet: {faulty[:1]}")
    values = [reading.value for reading in readings]
    span = max(values) - min(values)
    expect(
        abs(span - _STEP) < _COARSEST,
        f"{name}: the axis goes {_STEP} m to and fro, the readings {span} m (SI is expected)",
    )
    times = [reading.time for reading in readings]
    expect(times == sorted(times), f"{name}: times of arrival must not go back")
    expect(abs(times[-1] - time.monotonic()) < _PATIENCE, f"{name}: time must be that of time.monotonic")


@check
def sign_turns_it_round(instrument: Instrument, *_: Any) -> None:
    """Check that the sign, if there is such a key, is applied to the readings."""
    if "sign" not in instrument.options.model_fields:
        return
    for sign, direction in (("+", 1), ("-", -1)):
        with _run_emulated(instrument, MovingAxis(drift=_STEP)) as stage:
            readings = _watch(instrument, stage, sign=sign)
        moved = readings[-1].value - readings[0].value
        expect(
            moved * direction > 0,
            f"{instrument.identifier}: the axis goes up, and with sign '{sign}' readings go by {moved} m",
        )


@check
def no_wrong_reading_is_usable(instrument: Instrument, *_: Any) -> None:
    """Check that whatever goes wrong, what is called usable is right until the zero is called lost."""
    for trouble in ((Trouble.SKIPPED, Trouble.ERROR), (Trouble.LOST_BEAM,)):
        where = f"{instrument.identifier}: {', '.join(trouble)}"
        with _run_emulated(instrument, MovingAxis()) as stage:
            for reading in _watch(instrument, stage, *trouble):
                if reading.loses_zero:
                    break
                if reading.is_usable:
                    expect(
                        abs(reading.value) < _COARSEST,
                        f"{where}: the axis rests at 0, and {reading.value} m is called usable",
                    )
                else:
                    expect(
                        reading.message,
                        f"{where}: a reading is void, and no message says why",
                    )


@check
def no_cut_answer_is_usable(instrument: Instrument, *_: Any) -> None:
    """Check that what arrives with its end cut off is no reading: 1 is not 1.234 with the rest lost."""
    _expect_none_usable(instrument, _CutOff, "cut off")


@check
def no_garbled_answer_is_usable(instrument: Instrument, traits: InstrumentTraits | None = None) -> None:
    """Check that what arrives with a wrong sign in it is no reading; of digits, where a check tells."""
    _expect_traits(instrument, traits)
    _expect_none_usable(instrument, _Unreadable, "garbled (a digit is '?')")
    if traits and traits.has_check_sum:
        _expect_none_usable(instrument, _WrongDigit, "garbled (a digit is another, and the check sum is not)")


@check
def tells_of_a_lost_beam(instrument: Instrument, traits: InstrumentTraits | None = None) -> None:
    """Check that a lost signal ends the count: a reading is void and says that the zero is lost."""
    _expect_traits(instrument, traits)
    if traits and not traits.tells_lost_beam:
        return
    name = instrument.identifier
    with _run_emulated(instrument, MovingAxis()) as stage:
        readings = _watch(instrument, stage, Trouble.LOST_BEAM)
    expect(
        any(reading.loses_zero for reading in readings),
        f"{name}: the beam was lost, and no reading says so (a Fault that loses the zero, as "
        "Fault.BEAM_LOST); a run would go on with a count that is void",
    )


def _expect_traits(instrument: Instrument, traits: InstrumentTraits | None) -> None:
    expect(
        traits,
        f"{instrument.identifier}: say what its manual says: check_instrument(…, traits=InstrumentTraits("
        "has_check_sum=…, tells_lost_beam=…)); nobody else can tell a wrong digit from a reading",
    )


def _expect_none_usable(instrument: Instrument, damaging: type[_Damaging], what: str) -> None:
    """Expect that nothing is called usable that is not where the axis is, though sendings are damaged."""
    axis = MovingAxis((0.0, _FAR), feed=_AT_ONCE, dwell=_DWELL)
    stage = _Stage()
    try:
        with _serve(damaging(instrument.emulator(Scene(axis, stage.troubles))), stage):
            readings = _watch(instrument, stage)
    except AccessError:
        return  # it gave up, and said so
    for reading in readings:
        is_there = any(abs(reading.value - at) < _COARSEST for at in (0.0, _FAR))
        expect(
            is_there or not reading.is_usable,
            f"{instrument.identifier}: the axis rests at 0 and at {_FAR} m, some of what the instrument "
            f"sends is {what}, and {reading.value} m is called usable",
        )


@check
def notices_the_cable(instrument: Instrument, *_: Any) -> None:
    """Check that readings end with an `AccessError` when the instrument is unplugged."""
    with _run_emulated(instrument) as stage:
        stage.planned.append(Planned(Trouble.UNPLUGGED, _UNPLUGGED_AT))
        _expect_end(instrument, stage.port, "it was unplugged")


@check
def refuses_silence(instrument: Instrument, *_: Any) -> None:
    """Check that a port at which nothing speaks ends with an `AccessError`."""
    with socket.create_server(("127.0.0.1", 0)) as silent:
        _expect_end(instrument, f"socket://127.0.0.1:{silent.getsockname()[1]}", "nothing speaks")


@check
def refuses_another_device(instrument: Instrument, *_: Any) -> None:
    """Check that what another device sends ends with an `AccessError`."""
    stage = _Stage()
    with _serve(_Babble(), stage):
        _expect_end(instrument, stage.port, "another device speaks")


@check
def refuses_a_port_that_is_not_there(instrument: Instrument, *_: Any) -> None:
    """Check that a port that is not there, and a word that is none, are refused."""
    for port in ("/dev/there-is-no-such-port", "socket://127.0.0.1:1", "no-such-scheme://x"):
        _expect_end(instrument, port, f"there is no port {port}")


def _expect_end(instrument: Instrument, port: str, why: str) -> None:
    where = f"{instrument.identifier}: {why}"
    until = time.monotonic() + _PATIENCE
    try:
        with instrument.open(instrument.options.model_validate({"port": port})) as connection:
            for reading in connection.readings():
                late = time.monotonic() > until
                expect(not late, f"{where}, and it still reads after {_PATIENCE:g} s: {reading}")
    except ZlmreportError as error:
        if "no-such-scheme" not in port:
            expect(isinstance(error, AccessError), f"{where}: {error!r}; an AccessError is expected")
        places = {problem.place.file for problem in error.problems}
        expect(places == {port}, f"{where}: the message does not name the port: {error}")
    except AssertionError:
        raise
    except Exception as error:
        message = f"{where}: {error!r}; an AccessError with the port as its place is expected"
        raise AssertionError(message) from error
    else:
        message = (
            f"{where}: the readings end without a word; an AccessError with the port as its place is expected"
        )
        raise AssertionError(message)


class _Stage:
    """Where an emulated instrument stands, in a time of its own.

    What a check sees is no matter of how busy the computer is: that time waits where it was, and what goes
    wrong is reckoned from the first reading.
    """

    def __init__(self) -> None:
        self.port = ""
        self.planned: list[Planned] = []
        self.troubles = Troubles(self.planned)
        self.now = 0.0  #: Emulated s.
        self._looked = time.monotonic()

    def look_at_clock(self) -> float:
        before, self._looked = self._looked, time.monotonic()
        self.now += _HASTE * min(self._looked - before, _LONGEST_LOOK)
        return self.now


def _watch(instrument: Instrument, stage: _Stage, *troubles: Trouble, **keys: Any) -> list[LiveReading]:
    """Return the readings of some time; the time to begin comes on top, and then these troubles."""
    options = instrument.options.model_validate({"port": stage.port, **keys})
    with instrument.open(options) as connection:
        readings = connection.readings()
        found = list(islice(readings, 1))
        begun = stage.now
        stage.planned.extend(
            Planned(each, begun + _TROUBLE_AFTER + after) for after, each in enumerate(troubles)
        )
        for reading in readings:
            found.append(reading)
            if stage.now > begun + _WATCHED:
                return found
    return found


class _Damaging:
    """An instrument of whose sendings some arrive damaged."""

    def __init__(self, emulator: Any) -> None:
        self._emulator = emulator
        self._sent = 0

    def unasked(self, time: float) -> bytes:
        return self._pass(self._emulator.unasked(time))

    def answer(self, data: bytes, time: float) -> bytes:
        return self._pass(self._emulator.answer(data, time))

    def _pass(self, sending: bytes) -> bytes:
        self._sent += bool(sending)
        is_damaged = sending and self._sent > _SOUND_FIRST and self._sent % 4 == 0
        return self._damage(sending) if is_damaged else sending

    def _damage(self, sending: bytes) -> bytes:
        raise NotImplementedError


class _CutOff(_Damaging):
    """It loses the second half, as a line does that loses bytes."""

    def _damage(self, sending: bytes) -> bytes:
        return sending[: len(sending) // 2]


class _Unreadable(_Damaging):
    """A digit in the middle of the longest number is no digit."""

    def _damage(self, sending: bytes) -> bytes:
        at = _find_middle_digit(sending)
        return sending if at is None else sending[:at] + b"?" + sending[at + 1 :]


class _WrongDigit(_Damaging):
    """A digit in the middle of the longest number is another."""

    def _damage(self, sending: bytes) -> bytes:
        at = _find_middle_digit(sending)
        return (
            sending
            if at is None
            else sending[:at] + b"%d" % (9 - int(sending[at : at + 1])) + sending[at + 1 :]
        )


def _find_middle_digit(sending: bytes) -> int | None:
    """Return where the middle digit of the longest number stands; None where there is no number."""
    found = max(re.finditer(rb"\d+", sending), key=lambda each: len(each[0]), default=None)
    return None if found is None else (found.start() + found.end() - 1) // 2


class _Babble:
    """A device that sends text without an end."""

    def unasked(self, _time: float) -> bytes:
        return b"Good morning, I am a modem. \x00\xff"

    def answer(self, _data: bytes, _time: float) -> bytes:
        return b"What? OK? \x80"


@contextmanager
def _run_emulated(instrument: Instrument, axis: MovingAxis | None = None) -> Iterator[_Stage]:
    """Put its emulator on a socket; yield where it stands."""
    stage = _Stage()
    moving = axis or MovingAxis((0.0, _STEP), feed=_STEP, dwell=_DWELL)
    with _serve(instrument.emulator(Scene(moving, stage.troubles)), stage):
        yield stage


@contextmanager
def _serve(emulator: Any, stage: _Stage) -> Iterator[None]:
    ended = threading.Event()
    channel = LocalSocket()
    stage.port = channel.address

    def run() -> None:
        with channel:
            serve(emulator, channel, stage.troubles, is_over=ended.is_set, clock=stage.look_at_clock)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


#: Every check of an instrument, each called with it and with what its author knows of its protocol.
INSTRUMENT_CHECKS = list_checks_of(__name__)


def check_instrument(instrument: Instrument, *, traits: InstrumentTraits | None = None) -> None:
    """Run every check on a live instrument.

    Parameters
    ----------
    instrument
        The object that the plugin's hook returns.
    traits
        What its manual says of its protocol; without it the kit does not pass.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    run_all(INSTRUMENT, INSTRUMENT_CHECKS, instrument, traits)
