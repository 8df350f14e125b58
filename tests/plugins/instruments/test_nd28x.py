"""HEIDENHAIN displays: the documented dialogue, byte by byte, read, emulated, and held to another driver."""

from __future__ import annotations

import pytest

from installed import registry
from plugins.instruments.exchanges import dialogue
from plugins.instruments.lines import plugged_in, readings_of
from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.live.emulation.troubles import Planned, Troubles
from zlmreport.plugin.instrument import Emulator, Fault, Scene, Trouble
from zlmreport_plugins.instruments import nd28x as spoken

_UNITS = {
    "mm": spoken.PrintedUnit.MILLIMETRE,
    "inch": spoken.PrintedUnit.INCH,
    "fault": spoken.PrintedUnit.FAULT,
}


def _at(millimetres: float, *troubles: Trouble) -> Emulator:
    """Return a display at a position, of which something goes wrong after a second."""
    planned = Troubles([Planned(trouble, 1.0) for trouble in troubles])
    return registry().instrument("nd28x").emulator(Scene(MovingAxis((millimetres / 1e3,)), planned))


@pytest.mark.parametrize(("host", "display", "says"), dialogue())
def test_documented_answers_are_understood(host: bytes, display: bytes, says: str) -> None:  # noqa: ARG001
    kind, _, rest = says.partition(" ")
    if kind == "position":
        assert spoken.find_position_in(display) == int(rest.split()[0])
    elif kind == "printed":
        value, unit = rest.split()
        assert spoken.find_printed_in(display) == spoken.Printed(float(value), _UNITS[unit])
    else:
        assert spoken.find_text_in(display) == rest


@pytest.mark.parametrize(("host", "display", "says"), dialogue())
def test_an_answer_that_is_not_whole_is_none(host: bytes, display: bytes, says: str) -> None:  # noqa: ARG001
    for end in range(len(display)):
        assert spoken.find_position_in(display[:end]) is None
        assert spoken.find_printed_in(display[:end]) is None


def test_the_questions_are_those_of_the_manual() -> None:
    asked = {host for host, _, _ in dialogue()}
    assert {spoken.CURRENT_POSITION, spoken.PRINT, spoken.IDENTIFICATION} <= asked


@pytest.mark.parametrize(
    ("host", "display"),
    [
        (host, display)
        for host, display, says in dialogue()
        if says in {"position -123456 steps", "printed -12.3456 mm", "text ND-287 646118-01 V1-01"}
    ],
)
def test_the_emulated_display_answers_as_documented(host: bytes, display: bytes) -> None:
    assert _at(-12.3456).answer(host, 0.0) == display


def test_the_emulated_display_waits_for_the_rest_of_a_command() -> None:
    display = _at(1.0)
    answers = [display.answer(bytes([byte]), 0.0) for byte in spoken.CURRENT_POSITION]
    assert answers == [b""] * 6 + [b"\x02+000010000\r\n"]


def test_the_emulated_display_acknowledges_keys_and_refuses_what_it_does_not_know() -> None:
    assert _at(0.0).answer(spoken.write_command("T0001"), 0.0) == spoken.ACK
    assert _at(0.0).answer(spoken.write_command("X9999"), 0.0) == spoken.NAK


def test_a_position_is_read_over_a_line() -> None:
    with plugged_in(_at(-12.3456)) as port:
        (reading,) = readings_of(registry().instrument("nd28x"), port, 1)
    assert reading.value == pytest.approx(-12.3456e-3, abs=1e-12)
    assert reading.is_usable


def test_a_fault_voids_the_reading_with_the_text_of_the_display() -> None:
    with plugged_in(_at(5.0, Trouble.ERROR), begins_at=1.1) as port:
        (reading,) = readings_of(registry().instrument("nd28x"), port, 1)
    assert reading.faults == Fault.DEVICE_ERROR | Fault.BEAM_LOST
    assert "(Signal fault X1)" in reading.message


def test_the_fault_stays_until_it_is_cleared() -> None:
    display = _at(5.0, Trouble.LOST_BEAM)
    assert display.answer(spoken.PRINT, 9.0)[12:13] == b"?"
    display.answer(spoken.write_command("T0100"), 9.5)
    assert display.answer(spoken.PRINT, 10.0)[12:13] == b" "


@pytest.mark.filterwarnings("default")  # of its own libraries
def test_an_independent_driver_reads_the_emulated_display() -> None:
    """Runs where pymeasure and pyvisa-py are installed: they are no requirement of the project's tests."""
    heidenhain = pytest.importorskip("pymeasure.instruments.heidenhain")
    pytest.importorskip("pyvisa_py")
    with plugged_in(_at(-12.3456)) as port:
        driver = heidenhain.ND287(
            f"ASRL{port}::INSTR", visa_library="@py", baud_rate=9600, read_termination="\r\n"
        )
        assert driver.position == pytest.approx(-12.3456)
        assert "ND-287" in driver.id
        driver.adapter.close()
