"""A session takes one command to its end before the next, whatever else the server sends."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from processes import PATIENCE
from zlmreport.plugin import AccessError
from zlmreport_step_gauge.machines.session import ServerConnection, Session


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
