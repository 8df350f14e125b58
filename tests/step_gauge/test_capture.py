"""``zlmreport emulate ippdme`` and ``zlmreport capture``: a step gauge is probed without a machine."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from installed import load_job
from processes import ZLMREPORT, started
from step_gauge.emulated import on_a_port
from step_gauge.jobs import write_job
from zlmreport.cli import main
from zlmreport_step_gauge.machines.emulated import PRETRAVEL, make_machine_of_job
from zlmreport_step_gauge.machines.server import DmeServer, PointFault
from zlmreport_step_gauge.paths.plan import plan_path_of_job

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write_live_job(folder: Path, port: int, orientation: str = "y") -> Path:
    """Write a job whose machine is on a port of this computer."""
    machine = ("file: raw.csv", f"file: raw.csv, machine: {{host: 127.0.0.1, port: {port}, tool: RefTool}}")
    return write_job(folder, machine, orientation=orientation)


def emulated(folder: Path, orientation: str = "y", **faults: PointFault) -> DmeServer:
    """Return the machine of a job, with a scale error of 20 µm/m."""
    job = load_job(write_live_job(folder, 1294, orientation))
    machine = make_machine_of_job(job, scale_error=20e-6, noise=0.0)
    return DmeServer(machine, faults={int(number[1:]): fault for number, fault in faults.items()})


@pytest.mark.parametrize("orientation", ["x", "y", "z", "diagonal"])
def test_captured_points_show_the_machines_scale_error_in_any_orientation(
    folder: Path, orientation: str
) -> None:
    with on_a_port(emulated(folder, orientation)) as port:
        write_live_job(folder, port, orientation)
        assert main(["capture", "job.yaml"]) == 0
    rows = np.genfromtxt(folder / "raw.csv", delimiter=",", names=True, skip_header=2)
    job = load_job(folder / "job.yaml")
    planned = plan_path_of_job(job, job.own_keys("step_gauge"))
    centres = np.stack([rows["x"], rows["y"], rows["z"]], axis=-1) * 1e-3
    along = planned.frame.to_gauge(centres)[:, 0]
    side = np.where(rows["face"] % 2, -1, 1)
    radius = 2e-3 - PRETRAVEL
    true = 0.01 * (rows["face"] - 1) - 0.005 + side * radius
    # five digits of a millimetre, and the error of the error: 20e-6 of 20e-6 of 60 mm is nothing
    assert along - true == pytest.approx(20e-6 * true, abs=1.1e-8)


def test_lines_say_how_it_goes_on_and_what_comes_next(folder: Path, capsys: Capture) -> None:
    with on_a_port(emulated(folder)) as port:
        write_live_job(folder, port)
        assert main(["capture", "job.yaml"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"127.0.0.1:{port}  gauge.csv; Ctrl-C stops the machine"
    assert lines[1] == "12 points"
    assert lines[2].startswith("   1/12  cycle 1  face   1  300.0000  193.00")
    assert lines[-2:] == ["raw.csv", "next: zlmreport job.yaml"]


def test_a_missed_face_is_probed_by_the_same_command_again(folder: Path, capsys: Capture) -> None:
    with on_a_port(emulated(folder, n3=PointFault.NO_SURFACE)) as port:
        write_live_job(folder, port)
        assert main(["capture", "job.yaml"]) == 3
        found = capsys.readouterr()
        assert "  missed  face 5, cycle 1: 1006 Surface not found (PtMeas)" in found.out
        assert found.err.startswith("raw.csv.part: face 5, cycle 1, was missed: 1006 Surface not found")
        assert main(["capture", "job.yaml"]) == 0
    assert "12 points, 11 of them probed already\n" in capsys.readouterr().out
    assert (folder / "raw.csv").exists()


def test_json_has_a_line_for_each_event(folder: Path, capsys: Capture) -> None:
    with on_a_port(emulated(folder, n2=PointFault.NO_TOUCH)) as port:
        write_live_job(folder, port)
        assert main(["capture", "job.yaml", "--json"]) == 3
    events = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert events[0] == {"event": "begun", "done": 0, "points": 12}
    assert events[2] == {"event": "missed", "face": 3, "cycle": 1, "error": 1003}
    assert [event["event"] for event in events].count("probed") == 11


def test_a_step_gauge_without_a_machine_is_told_what_it_needs(folder: Path, capsys: Capture) -> None:
    write_job(folder)
    assert main(["capture", "job.yaml"]) == 2
    message = "job.yaml:5:20: a step gauge is probed by a machine; state measurement.source.machine, such as"
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("option", [["--end"], ["--journal", "other.csv"]])
def test_options_for_interferometers_are_refused(folder: Path, capsys: Capture, option: list[str]) -> None:
    write_live_job(folder, 1294)
    assert main(["capture", "job.yaml", *option]) == 2
    assert f"{option[0]} is of no use with a step gauge" in capsys.readouterr().err


def test_the_emulated_machine_is_probed_and_evaluated_as_the_how_to_tells(folder: Path) -> None:
    write_job(folder)
    command = (*ZLMREPORT, "emulate", "ippdme", "--job", "job.yaml", "--port", "0")
    with started(*command) as emulation:
        printed = emulation.lines(3)
        write_live_job(folder, int(printed[1].rpartition(":")[2]))
        assert main(["capture", "job.yaml"]) == 0
        emulation.ended()
    assert printed[0] == "ippdme: coordinate measuring machine, I++ DME, emulated\n"
    assert main(["job.yaml", "--format", "json", "--quiet"]) == 0
    results = json.loads((folder / "CMM-7.json").read_text("utf-8"))
    assert results["evaluations"][0]["standard"] == "iso230-2:2014"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["ippdme"], "ippdme needs the job whose gauge lies on it: --job JOB.yaml"),
        (["ippdme", "--job", "job.yaml", "--link", "cmm"], "unknown option '--link'"),
        (["umd1", "--scale-error", "3"], "unknown option '--scale-error'"),
        (["ippdme", "--point-fault", "no-tuch@1"], "did you mean 'no-touch'?"),
        (["ippdme", "--point-fault", "no-touch@0"], "does not say at which move"),
        (["ippdme", "--point-fault", f"no-touch@{'9' * 5000}"], "does not say at which move"),
        (["ippdme", "--noise", "-1"], "'-1' is negative, and no standard deviation is"),
    ],
)
def test_a_mistake_is_told_and_nothing_begins(arguments: list[str], message: str, capsys: Capture) -> None:
    assert main(["emulate", *arguments]) == 2
    assert message in capsys.readouterr().err
