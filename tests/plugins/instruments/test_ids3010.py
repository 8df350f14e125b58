"""attocube IDS3010: the published exchange, byte by byte, read and emulated."""

from __future__ import annotations

import json

import pytest

from installed import registry
from plugins.instruments.exchanges import questions_and_answers
from plugins.instruments.lines import plugged_in, readings_of
from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.live.emulation.troubles import Planned, Troubles
from zlmreport.plugin import AccessError
from zlmreport.plugin.instrument import Fault, Scene, Trouble
from zlmreport_plugins.instruments.ids3010 import Ids3010Emulator, IdsAnswer, answer_to, write_question

EXCHANGE = questions_and_answers()


@pytest.mark.parametrize(("asked", "answered"), EXCHANGE)
def test_questions_are_those_that_are_published(asked: bytes, answered: bytes) -> None:  # noqa: ARG001
    message = json.loads(asked)
    assert write_question(message["id"], message["method"], *message["params"]) == asked


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        (1, IdsAnswer(1, 0, (12345678901,))),
        (2, IdsAnswer(2, 0, (12345678901, 0, 0))),
        (3, IdsAnswer(3, 0, ("measurement running",))),
        (5, IdsAnswer(5, 0, (20.13,))),
        (9, IdsAnswer(9, error="Method not found", is_unknown=True)),
    ],
)
def test_published_answers_are_understood(number: int, expected: IdsAnswer) -> None:
    arrived = b"".join(answered for _, answered in EXCHANGE)
    assert answer_to(number, arrived) == expected


def test_an_answer_that_is_not_whole_is_none() -> None:
    _, answered = EXCHANGE[0]
    whole = answered.index(b"}") + 1
    assert [answer_to(1, answered[:end]) for end in range(whole)] == [None] * whole


@pytest.mark.parametrize(
    "text", [b"[]", b"17", b'{"id":1}', b'{"id":1,"result":[]}', b'{"id":1,"result":["0"]}']
)
def test_what_is_no_answer_is_none(text: bytes) -> None:
    assert answer_to(1, text) is None


def test_the_emulated_device_answers_as_published() -> None:
    device = Ids3010Emulator(Scene(MovingAxis((0.012345678901,))))
    assert device.answer(EXCHANGE[0][0], 0.0) == EXCHANGE[0][1]
    assert json.loads(device.answer(EXCHANGE[-1][0], 0.0)) == json.loads(EXCHANGE[-1][1])


def test_the_emulated_device_takes_questions_in_pieces() -> None:
    device = Ids3010Emulator(Scene())
    asked = EXCHANGE[0][0] + EXCHANGE[1][0]
    answers = b"".join(device.answer(bytes([byte]), 0.0) for byte in asked)
    assert answers.count(b"\r\n") == 2


def test_a_device_that_is_idle_is_started_and_read_with_its_air() -> None:
    with plugged_in(Ids3010Emulator(Scene(MovingAxis((0.1,))))) as port:
        (reading,) = readings_of(registry().instrument("ids3010"), port, 1)
    assert reading.value == 0.0  # from where it was when it began
    assert dict(reading.conditions) == {
        "air_temperature": pytest.approx(293.15),
        "air_pressure": 101325.0,
        "relative_humidity": pytest.approx(0.5),
    }


def test_a_warning_voids_the_reading() -> None:
    scene = Scene(troubles=Troubles([Planned(Trouble.ERROR, start / 2) for start in range(20)]))
    with plugged_in(Ids3010Emulator(scene)) as port:
        (reading,) = readings_of(registry().instrument("ids3010"), port, 1)
    assert reading.faults == Fault.DEVICE_ERROR
    assert "warning 1" in reading.message


def test_a_broken_beam_ends_the_measurement_and_loses_the_zero() -> None:
    scene = Scene(troubles=Troubles([Planned(Trouble.LOST_BEAM, 1.0)]))
    with plugged_in(Ids3010Emulator(scene)) as port:
        last = readings_of(registry().instrument("ids3010"), port, 60)[-1]
    assert last.faults == Fault.BEAM_LOST
    assert "system idle" in last.message


def test_it_counts_from_where_it_is_told_to() -> None:
    instrument = registry().instrument("ids3010")
    with (
        plugged_in(Ids3010Emulator(Scene(MovingAxis((0.0, 0.1), feed=10.0, dwell=1.5)))) as port,
        instrument.open(instrument.options.model_validate({"port": port})) as connection,
    ):
        readings = connection.readings()
        assert connection.can_zero
        while next(readings).value < 0.09:
            pass
        connection.zero()
        assert next(readings).value == 0.0


class _Newer(Ids3010Emulator):
    """A device whose firmware calls its methods by other names."""

    def answer(self, data: bytes, time: float) -> bytes:
        return super().answer(
            data.replace(b"attocube.ids", b"gone").replace(b"attocube.sen", b"attocube.ids"), time
        )


def test_newer_firmware_is_read_too() -> None:
    with plugged_in(_Newer(Scene())) as port:
        (reading,) = readings_of(registry().instrument("ids3010"), port, 1)
    assert reading.is_usable


class _Neither(Ids3010Emulator):
    def answer(self, data: bytes, time: float) -> bytes:
        return super().answer(data.replace(b"attocube", b"gone"), time)


def test_a_device_that_knows_no_mode_is_refused() -> None:
    with plugged_in(_Neither(Scene())) as port, pytest.raises(AccessError, match="is it an IDS3010"):
        readings_of(registry().instrument("ids3010"), port, 1)
