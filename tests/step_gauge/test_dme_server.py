"""The emulated machine speaks I++ DME as a real one does, and takes nothing that is none."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from zlmreport_step_gauge.machines.emulated import Boxes, CoordinateMachine
from zlmreport_step_gauge.machines.server import DmeServer, PointFault

DATA = Path(__file__).parents[1] / "data/ippdme"
ANSWERS = DATA.parent / "step_gauge/stepgauge.res"
#: The sample's gauge: front faces every 20 mm from y = 41.013 mm on, blocks of 10 mm, along (−0.0006, 1, 0).
FIRST_FACE = np.array([290.862e-3, 41.013e-3, 201.28e-3])


def sample_server(*faults: PointFault) -> DmeServer:
    """Return a server of which the measuring moves meet faults in turn."""
    along = np.array([-0.0006, 0.9999998, 0.0])
    axes = np.array([along, np.cross(along, [0.0, 0.0, 1.0]), [0.0, 0.0, 1.0]])
    lower = np.array([[0.02 * block, -0.005, -0.005] for block in range(5)])
    boxes = Boxes(FIRST_FACE, axes, lower, lower + 0.01 * np.ones(3))
    machine = CoordinateMachine(boxes, effective_radius=1.9985e-3)
    return DmeServer(machine, faults=dict(enumerate(faults, start=1)))


def commands(name: str) -> list[str]:
    """Return the commands of a file, without its separators."""
    lines = (DATA / name).read_bytes().decode("ascii").split("\r\n")
    return [line for line in lines if line not in {"\\\\", ":", ""}]


def answers(server: DmeServer, *lines: str) -> list[str]:
    return server.answer("".join(f"{line}\r\n" for line in lines).encode(), 0.0).decode().splitlines()


def begun(server: DmeServer) -> DmeServer:
    """Return a server in whose session the machine is ready."""
    assert len(answers(server, "00001 StartSession()", "00002 Home()")) == 4
    return server


def test_the_sample_program_gets_the_answers_of_the_sample_server() -> None:
    lines = ANSWERS.read_text("ascii").splitlines()
    expected = [line for line in lines if line not in {"\\\\", ":", ""}]
    found = answers(sample_server(), *commands("stepgauge.prg"))
    number = re.compile(r"-?\d+\.\d+")
    assert [number.sub("N", line) for line in found] == [number.sub("N", line) for line in expected]
    for mine, its in zip(found, expected, strict=True):
        values = [[float(each) for each in number.findall(line)] for line in (mine, its)]
        # the sample's machine has errors of a few micrometres; normals are printed alike
        assert values[0] == pytest.approx(values[1], abs=6e-3)


def test_a_command_without_its_bracket_is_refused_and_so_is_all_that_follows() -> None:
    found = answers(sample_server(), *commands("bad.prg")[:11])
    errors = [line for line in found if " ! " in line]
    assert errors[0] == '00090 ! Error(3, 0502, OnPtMeasReport, "Incorrect arguments")'
    assert errors[1] == '00100 ! Error(2, 0514, GoTo, "Use ClearAllErrors to continue")'


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("00003 home()", "0501"),
        ("00003 GoTo(1, 2, 3)", "0502"),
        ("00003 GoTo(X(1.0), Y(2.0))", "0502"),
        ("00003 PtMeas(X(1.0), Y(2.0), Z(3.0), IJK(0.0, 0.0, 2.0))", "0502"),
        ('00003 ChangeTool("Star")', "1502"),
        ("00003 SetProp(Tool.GoToPar.Colour(3))", "0502"),
        ("00000 Home()", "0001"),
        ("00003Home()", "0008"),
        ("what?", "0008"),
        ("00003 GoTo(X(99999.0), Y(0.0), Z(0.0))", "2500"),
    ],
)
def test_what_is_no_command_has_the_error_that_says_so(line: str, error: str) -> None:
    found = answers(begun(sample_server()), line)
    assert [text.split(", ")[1] for text in found if " ! " in text] == [error]
    assert found[-1].endswith(" %")


def test_nothing_is_done_before_a_session_and_before_home() -> None:
    server = sample_server()
    assert "0508" in answers(server, "00001 Home()")[1]
    server = sample_server()
    assert "0508" in answers(server, "00001 StartSession()", "00002 GoTo(X(0.0), Y(0.0), Z(0.0))")[-2]


def test_after_an_error_only_clear_all_errors_helps() -> None:
    server = begun(sample_server())
    answers(server, "00003 home()")
    assert "0514" in answers(server, "00004 Home()")[1]
    assert answers(server, "00005 ClearAllErrors()", "00006 Home()") == [
        "00005 &",
        "00005 %",
        "00006 &",
        "00006 %",
    ]


def test_commands_may_arrive_in_pieces() -> None:
    server = sample_server()
    assert server.answer(b"00001 StartSe", 0.0) == b""
    assert server.answer(b"ssion()\r", 0.0) == b""
    assert server.answer(b"\n00002", 0.0) == b"00001 &\r\n00001 %\r\n"


MEASURE = "00004 PtMeas(X(290.862), Y(41.013), Z(201.280), IJK(0.0006000, -0.9999998, 0.0))"


def test_an_emergency_stop_is_told_unasked_too() -> None:
    server = begun(sample_server(PointFault.EMERGENCY_STOP))
    assert answers(server, MEASURE) == [
        "00004 &",
        'E0000 ! Error(3, 0500, Server, "Emergency stop")',
        '00004 ! Error(3, 0500, PtMeas, "Emergency stop")',
        "00004 %",
    ]


def test_with_a_lost_connection_nothing_comes_any_more() -> None:
    server = begun(sample_server(PointFault.LOST_CONNECTION))
    assert answers(server, MEASURE) == ["00004 &"]
    assert server.is_gone


def test_a_temperature_comes_with_the_point_if_it_is_asked_for() -> None:
    server = begun(sample_server())
    (report,) = [
        line
        for line in answers(server, "00003 OnPtMeasReport(X(), Y(), Z(), Temperature())", MEASURE)
        if " # " in line
    ]
    assert report.endswith("Temperature(20.000)")
    assert "IJK" not in report
