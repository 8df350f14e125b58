"""A session takes one command to its end before the next; each line of the protocol is read, and no other."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from processes import PATIENCE
from zlmreport.plugin import AccessError
from zlmreport_step_gauge.machines.session import (
    Answer,
    LineKind,
    MachineError,
    ServerConnection,
    Session,
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


@contextmanager
def answering(*answers: str) -> Iterator[tuple[Session, list[str], list[str]]]:
    """Return a session with a server that answers each command with the next text, whatever it is.

    The lists are the commands that it gets and what the session tells of events.
    """
    heard: list[str] = []
    told: list[str] = []
    with socket.create_server(("127.0.0.1", 0)) as listening:

        def serve() -> None:
            client, _ = listening.accept()
            with client, client.makefile("rw", newline="", encoding="ascii") as lines:
                for answer in answers:
                    heard.append(lines.readline())
                    lines.write(answer.replace("\n", "\r\n"))
                    lines.flush()
                lines.read()

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        with ServerConnection("127.0.0.1", listening.getsockname()[1]) as connection:
            yield Session(connection, 0.2, told.append), heard, told
        thread.join(PATIENCE)


def test_commands_have_rising_tags_and_end_with_cr_lf() -> None:
    with answering("00001 &\n00001 %\n", "00002 &\n00002 %\n") as (session, heard, _):
        session.order("StartSession()")
        session.order("Home()")
    assert heard == ["00001 StartSession()\r\n", "00002 Home()\r\n"]


def test_data_come_in_their_order() -> None:
    with answering("00001 &\n00001 # X(1.0)\n00001 # X(2.0)\n00001 %\n") as (session, *_):
        assert session.order("PtMeas()") == ["X(1.0)", "X(2.0)"]


def test_events_in_between_are_told_and_change_nothing() -> None:
    with answering('E0000 # KeyPress("F1")\n00001 &\nE0000 # Moving()\n00001 %\n') as (session, _, told):
        assert session.order("Home()") == []
    assert told == ['KeyPress("F1")', "Moving()"]


def test_a_warning_is_told_and_the_command_has_succeeded() -> None:
    text = '00001 &\n00001 ! Error(1, 0504, SetProp, "Argument out of range")\n00001 %\n'
    with answering(text) as (session, _, told):
        session.order("SetProp(Tool.GoToPar.Speed(900))")
    assert told == ["0504 Argument out of range (SetProp)"]


def test_an_emergency_stop_that_nobody_asked_for_ends_the_session() -> None:
    text = '00001 &\nE0000 ! Error(3, 0500, Server, "Emergency stop")\n'
    with answering(text) as (session, *_), pytest.raises(AccessError, match="release it"):
        session.order("Home()")


def test_an_error_that_an_earlier_session_has_left_is_cleared_once() -> None:
    stuck = '00001 &\n00001 ! Error(2, 0514, Home, "Use ClearAllErrors to continue")\n00001 %\n'
    with answering(stuck, "00002 &\n00002 %\n", "00003 &\n00003 %\n") as (session, heard, _):
        session.begin(["Home()"])
    assert [line.split()[1] for line in heard] == ["Home()", "ClearAllErrors()", "Home()"]


def test_an_error_that_appears_on_the_way_is_never_cleared_unseen() -> None:
    stuck = '00001 &\n00001 ! Error(2, 0514, GoTo, "Use ClearAllErrors to continue")\n00001 %\n'
    with answering(stuck) as (session, *_), pytest.raises(AccessError, match="clear it at the machine"):
        session.order("GoTo()")


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ("00001 %\n", "% at the wrong place"),
        ("00001 # X(1.0)\n", "# at the wrong place"),
        ("00001 &\n00001 &\n", "& at the wrong place"),
        ("00002 &\n", "an answer to 00002 where one to 00001 is expected"),
        ("HTTP/1.1 400 Bad Request\n", "is no answer of I\\+\\+ DME; is this the port"),
        ("00001 &\n00001 ! Oops\n", "is no error of I\\+\\+ DME"),
        ("00001 &\n", "the machine does not answer to Home"),
    ],
)
def test_a_server_that_does_not_keep_to_the_protocol_is_told(answer: str, message: str) -> None:
    with answering(answer) as (session, *_), pytest.raises(AccessError, match=message):
        session.order("Home()")


def test_a_server_that_hangs_up_is_told() -> None:
    with (
        socket.create_server(("127.0.0.1", 0)) as listening,
        ServerConnection("127.0.0.1", listening.getsockname()[1]) as connection,
    ):
        client, _ = listening.accept()
        client.close()
        with pytest.raises(AccessError, match="is lost"):
            Session(connection, 0.2, print).order("Home()")


def test_abort_goes_out_at_once_under_an_event_tag() -> None:
    with answering("") as (session, heard, _):
        session.abort()
    assert heard == ["E0001 AbortE()\r\n"]
