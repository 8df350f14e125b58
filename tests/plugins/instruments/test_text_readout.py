"""Any readout: what its lines mean, as the job says."""

from __future__ import annotations

import math

import pytest
from pydantic import ValidationError

from installed import registry
from plugins.instruments.lines import plugged_in, readings_of
from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.plugin.instrument import Fault, Framing, Scene
from zlmreport_plugins.instruments.text_readout import (
    TextDecoder,
    TextEmulator,
    TextReadoutOptions,
)


def _value(line: bytes, **keys: object) -> float:
    decoder = TextDecoder(TextReadoutOptions(port="COM3", **keys))  # type: ignore[arg-type]
    (reading,) = decoder.feed(line + b"\r\n", 1.0)
    return reading.value


@pytest.mark.parametrize(
    ("line", "metres"),
    [
        (b"12.345", 12.345e-3),
        (b"  -  12.345 mm ", -12.345e-3),
        (b"+0012,345 mm", 12.345e-3),
        (b"1.5 inch", 38.1e-3),
        ("250 µm".encode(), 250e-6),
    ],
)
def test_usual_lines_need_no_pattern(line: bytes, metres: float) -> None:
    assert _value(line) == pytest.approx(metres, rel=1e-12)


@pytest.mark.parametrize(
    ("line", "pattern", "metres"),
    [
        (b"A+12.345", r"A(?P<value>[+-]\d+\.\d+)", 12.345e-3),  # Magnescale LT10A, channel A
        (b"1 -012.34 mm =", r"1 (?P<value>[+-]\d+\.\d+) (?P<unit>mm) =", -12.34e-3),  # Mahr C1202
    ],
)
def test_lines_of_known_readouts_are_read_by_their_pattern(line: bytes, pattern: str, metres: float) -> None:
    assert _value(line, pattern=pattern) == pytest.approx(metres, rel=1e-12)


def test_the_unit_is_the_jobs_where_the_line_has_none() -> None:
    assert _value(b"180", unit="deg") == pytest.approx(math.pi)


@pytest.mark.parametrize("line", [b"12.345 12.345", b"x12.345", b"12.3.45", b"\xff\xfe", b"12.345 furlong"])
def test_what_the_pattern_does_not_fit_is_unreadable(line: bytes) -> None:
    decoder = TextDecoder(TextReadoutOptions(port="COM3"))
    (reading,) = decoder.feed(line + b"\n", 1.0)
    assert reading.faults == Fault.UNREADABLE
    assert math.isnan(reading.value)
    assert decoder.understood == 0


@pytest.mark.parametrize("line", [b"nan", b"-inf", b"Infinity"])
def test_a_word_for_no_number_is_unreadable_whatever_the_pattern(line: bytes) -> None:
    (reading,) = TextDecoder(TextReadoutOptions(port="COM3", pattern="(?P<value>.*)")).feed(line + b"\n", 1.0)
    assert reading.faults == Fault.UNREADABLE


def test_an_error_of_the_readout_voids_the_reading_and_the_zero() -> None:
    (reading,) = TextDecoder(TextReadoutOptions(port="COM3", no_reading=("ERR6",))).feed(b"ERR6\r", 1.0)
    assert reading.loses_zero
    assert "'ERR6'" in reading.message


def test_framing_is_the_jobs() -> None:
    options = TextReadoutOptions(port="COM3", bits=7, parity="even", stop_bits=2)
    assert options.framing == Framing(9600, 7, "E", 2)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"pattern": "("}, "no regular expression"),
        ({"pattern": r"\d+"}, "needs a group"),
        ({"unit": "furlong"}, "is no unit"),
        ({"port": ""}, "name of a port"),
        ({"scale": 0}, "greater than 0"),
    ],
)
def test_keys_that_make_no_sense_are_refused(keys: dict[str, object], message: str) -> None:
    with pytest.raises(ValidationError, match=message):
        TextReadoutOptions.model_validate({"port": "COM3", **keys})


def test_a_readout_that_sends_unasked_is_read() -> None:
    with plugged_in(TextEmulator(Scene(MovingAxis((0.0123456,))))) as port:
        readings = readings_of(registry().instrument("text-readout"), port, 3)
    assert [each.value for each in readings] == pytest.approx([0.0123456] * 3)


class _OnRequest(TextEmulator):
    """A readout that answers ``M?`` with a line."""

    def unasked(self, time: float) -> bytes:  # noqa: ARG002
        return b""

    def answer(self, data: bytes, time: float) -> bytes:
        return self._write_line(time) * data.count(b"M?\r")


def test_a_readout_that_is_asked_is_read() -> None:
    with plugged_in(_OnRequest(Scene(MovingAxis((0.0123456,))))) as port:
        readings = readings_of(registry().instrument("text-readout"), port, 3, request="M?\r", rate=100)
    assert [each.value for each in readings] == pytest.approx([0.0123456] * 3)


class _Echoing(_OnRequest):
    """A readout that sends back what it is asked, before its line."""

    def answer(self, data: bytes, time: float) -> bytes:
        return data + b"\n" + super().answer(data, time)


def test_a_readout_that_sends_back_its_questions_is_read() -> None:
    with plugged_in(_Echoing(Scene(MovingAxis((0.0123456,))))) as port:
        readings = readings_of(registry().instrument("text-readout"), port, 3, request="M?\r", rate=100)
    assert [each.value for each in readings] == pytest.approx([0.0123456] * 3)
