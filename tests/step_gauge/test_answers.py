"""Every line of the protocol is read, and no other."""

from __future__ import annotations

import pytest

from zlmreport_step_gauge.machines.session import (
    Answer,
    LineKind,
    MachineError,
    UnreadableError,
    read_answer,
    read_data,
    read_error,
)


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("00010 &", Answer("00010", LineKind.ACKNOWLEDGED)),
        ("99990 %", Answer("99990", LineKind.DONE)),
        ("00120 # X(1.5)", Answer("00120", LineKind.DATA, "X(1.5)")),
        (
            'E0000 ! Error(3, 0500, Server, "Stop")',
            Answer("E0000", LineKind.ERROR, 'Error(3, 0500, Server, "Stop")'),
        ),
    ],
)
def test_lines_are_told_apart(line: str, answer: Answer) -> None:
    assert read_answer(line) == answer


@pytest.mark.parametrize("line", ["", "0010 &", "00010&", "00010 ?", "HTTP/1.1 400 Bad Request", "E12 %"])
def test_what_is_no_answer_is_not_taken_for_one(line: str) -> None:
    with pytest.raises(UnreadableError, match=r"is no answer of I\+\+ DME"):
        read_answer(line)


def test_the_severity_says_whether_an_error_is_in_the_way() -> None:
    warning = read_error('Error(1, 0504, SetProp, "Argument out of range")')
    error = read_error('Error(2,1006,PtMeas,"Surface not found")')
    assert (warning.is_in_the_way, error.is_in_the_way) == (False, True)
    assert error == MachineError(2, 1006, "PtMeas", "Surface not found")
    assert str(error) == "1006 Surface not found (PtMeas)"


@pytest.mark.parametrize("text", ["Error(1006)", 'Error(2, x, PtMeas, "no")', 'Error(2, 1006, PtMeas, "no'])
def test_an_error_that_is_cut_off_is_not_read(text: str) -> None:
    with pytest.raises(UnreadableError):
        read_error(text)


def test_a_report_has_numbers_by_their_names() -> None:
    text = "X(290.86320), Y(39.01575), Z(201.28000), IJK(0.0006000,-0.9999998,-0.0000000)"
    assert read_data(text) == {
        "X": (290.8632,),
        "Y": (39.01575,),
        "Z": (201.28,),
        "IJK": (0.0006, -0.9999998, -0.0),
    }


@pytest.mark.parametrize("text", ["X(1.0", "X(one)", "X(1.0) Y(2.0)", "1.0, 2.0", "X(nan)", "X(1e999)"])
def test_a_report_that_is_none_is_not_read(text: str) -> None:
    with pytest.raises(UnreadableError):
        read_data(text)
