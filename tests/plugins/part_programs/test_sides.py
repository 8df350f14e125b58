"""What a program does beside the path and the feed that the kit looks at: its waits, a single run, rs274."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from plugins.part_programs.controls import CONTROLS, linuxcnc
from plugins.part_programs.planned import written
from processes import run
from zlmreport.model.planning.methods import Method
from zlmreport.testing import sample_motion

controls = pytest.mark.parametrize("control", CONTROLS)
methods = pytest.mark.parametrize("method", Method)


@methods
def test_interpreter_of_linuxcnc_makes_the_same_moves(method: Method, tmp_path: Path) -> None:
    text = written("linuxcnc", sample_motion(method))
    assert _interpreted(text, tmp_path) == linuxcnc(text).stops


@controls
@pytest.mark.parametrize("method", [Method.LINEAR, Method.UNIDIRECTIONAL])
def test_a_run_has_a_program_of_its_own_from_the_datum_and_back(control: str, method: Method) -> None:
    whole = sample_motion(method, runs=3)
    machine = CONTROLS[control](written(control, whole.of_run(2)))
    assert machine.waits == [machine.stops[0][0]] == [machine.stops[-1][0]] == [whole.stops[0].position]
    readings = [stop for stop in whole.stops if stop.reading and stop.reading.run == 2]
    assert [here for here, rest in machine.stops if rest] == [stop.position for stop in readings]


def test_interpreter_of_linuxcnc_runs_a_single_run(tmp_path: Path) -> None:
    text = written("linuxcnc", sample_motion(Method.LINEAR, runs=3).of_run(3))
    assert "run 3 of 3" in text
    assert _interpreted(text, tmp_path) == linuxcnc(text).stops


def _interpreted(text: str, tmp_path: Path) -> list[tuple[float, float]]:
    """Return the stops of a program by LinuxCNC's own interpreter, where that is installed."""
    rs274 = shutil.which("rs274")
    if rs274 is None:
        pytest.skip("LinuxCNC's stand-alone interpreter, rs274, is not installed")
    (tmp_path / "test.ngc").write_text(text, encoding="ascii")
    for name in ("variables", "tools"):
        (tmp_path / name).touch()
    done = run(rs274, "-v", "variables", "-t", "tools", "-g", "test.ngc", cwd=tmp_path, check=True)
    stops: list[tuple[float, float]] = []
    for call, first in re.findall(r"(STRAIGHT_FEED|DWELL)\((-?[\d.]+)", done.stdout):
        if call == "STRAIGHT_FEED":
            stops.append((float(first), 0.0))
        else:
            stops[-1] = stops[-1][0], float(first)
    return stops


@controls
def test_a_program_waits_at_the_datum_and_comes_back_to_it(control: str) -> None:
    machine = CONTROLS[control](written(control, sample_motion(Method.PENDULUM)))
    assert machine.waits == [machine.stops[0][0]] == [machine.stops[-1][0]]


@controls
@pytest.mark.parametrize(("wait", "times"), [("start", 1), ("runs", 3), ("never", 0)])
def test_a_program_waits_before_each_run_if_asked(control: str, wait: str, times: int) -> None:
    motion = sample_motion(Method.UNIDIRECTIONAL, runs=3)
    assert len(CONTROLS[control](written(control, motion, wait=wait)).waits) == times
