"""A path is run to its end, or to where it can go on; what was probed is never lost."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from processes import PATIENCE, awaited
from step_gauge.emulated import RADIUS, Notes, on_a_port, server, small_path
from step_gauge.paths import planned
from zlmreport.plugin import AccessError, InputError
from zlmreport_step_gauge.keys import MachineKeys
from zlmreport_step_gauge.machines.run import LiveProbing, run_probing
from zlmreport_step_gauge.machines.server import DmeServer
from zlmreport_step_gauge.paths.plan import PlannedPath

Run = Callable[..., Notes]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Return a function that runs a path on a server into ``raw.csv``."""

    def probe(dme: DmeServer, path: PlannedPath | None = None, tool: str | None = None) -> Notes:
        notes = Notes()
        with on_a_port(dme) as port:
            keys = MachineKeys(host="127.0.0.1", port=port, timeout=PATIENCE, tool=tool)
            run_probing(LiveProbing(path or small_path(), keys, tmp_path / "raw.csv"), notes)
        return notes

    return probe


def rows(path: Path) -> list[dict[str, str]]:
    """Return the rows of a table, its remarks left out."""
    return list(csv.DictReader(line for line in path.read_text("ascii").splitlines() if line[0] != "#"))


def test_every_point_is_the_tips_centre_an_effective_radius_before_its_face(run: Run, tmp_path: Path) -> None:
    path = small_path()
    run(server(path))
    targets = {(each.face, each.cycle): each for each in path.path.probings}
    for row in rows(tmp_path / "raw.csv"):
        probing = targets[int(row["face"]), int(row["cycle"])]
        centre = np.array([float(row[axis]) for axis in "xyz"]) * 1e-3
        assert centre == pytest.approx(np.array(probing.away(RADIUS)), abs=5.1e-9)  # five digits of mm
        assert [float(row[axis]) for axis in "ijk"] == pytest.approx(probing.normal, abs=5.1e-8)


def test_the_table_has_the_columns_of_the_data_source_and_says_what_it_holds(
    run: Run, tmp_path: Path
) -> None:
    run(server(small_path()))
    lines = (tmp_path / "raw.csv").read_text("ascii").splitlines()
    assert lines[0] == "# Gauge 7, job P-1; I++ DME, centres of the tip, mm, nominal radius 2 mm"
    assert lines[2] == "face,cycle,x,y,z,i,j,k"
    assert not (tmp_path / "raw.csv.part").exists()


def test_a_missed_face_is_named_and_the_others_are_probed(run: Run, tmp_path: Path) -> None:
    dme = server(small_path(), no_surface=2)
    with pytest.raises(AccessError, match=r"face 3, cycle 1, was missed: 1006 Surface not found"):
        run(dme)
    assert [int(row["face"]) for row in rows(tmp_path / "raw.csv.part")] == [1, 4, 2]
    assert not (tmp_path / "raw.csv").exists()


def test_the_next_run_probes_only_what_is_missing(run: Run, tmp_path: Path) -> None:
    with pytest.raises(AccessError):
        run(server(small_path(), no_touch=2))
    notes = run(server(small_path()))
    assert notes.begun_with == [(3, 4)]
    assert [face for face, _, _ in notes.points] == [3]
    assert sorted(int(row["face"]) for row in rows(tmp_path / "raw.csv")) == [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ("collision", r"the machine stopped: 2504 Collision \(PtMeas\); the machine has run into something"),
        ("emergency_stop", r"the machine stopped: 0500 Emergency stop .*; the emergency stop is pressed"),
        ("lost_connection", r"the connection to the machine is lost \(it has hung up\)"),
    ],
)
def test_a_run_that_is_stopped_keeps_its_points_and_goes_on(
    run: Run, tmp_path: Path, fault: str, message: str
) -> None:
    with pytest.raises(AccessError, match=message):
        run(server(small_path(), **{fault: 3}))
    assert [int(row["face"]) for row in rows(tmp_path / "raw.csv.part")] == [1, 3]
    assert [face for face, _, _ in run(server(small_path())).points] == [4, 2]


def test_the_same_server_takes_the_next_run_after_an_error(run: Run) -> None:
    dme = server(small_path(), collision=1)
    with pytest.raises(AccessError):
        run(dme)
    assert len(run(dme).points) == 4


def test_a_block_that_is_not_there_is_missed_on_both_sides(run: Run, tmp_path: Path) -> None:
    path = small_path()
    dme = server(path)
    lower, upper = dme.machine.boxes.lower.copy(), dme.machine.boxes.upper.copy()
    lower[1], upper[1] = 10.0, 10.1
    dme.machine.boxes = replace(dme.machine.boxes, lower=lower, upper=upper)
    with pytest.raises(AccessError) as caught:
        run(dme)
    assert [problem.message.partition(",")[0] for problem in caught.value.problems] == ["face 3", "face 4"]
    assert len(rows(tmp_path / "raw.csv.part")) == 2


def test_a_gauge_that_has_moved_stops_the_run_at_the_collision(run: Run) -> None:
    path = small_path()
    dme = server(path)
    boxes = dme.machine.boxes
    dme.machine.boxes = replace(boxes, origin=boxes.origin + np.array([0.0, 0.012, 0.0]))
    with pytest.raises(AccessError, match="2504 Collision \\(GoTo\\)"):
        run(dme)


def test_a_tool_that_the_machine_lacks_is_said(run: Run) -> None:
    with pytest.raises(AccessError, match=r"1502 Tool not found \(ChangeTool\); the machine has no tool"):
        run(server(small_path()), tool="Star")


def test_an_interrupt_stops_the_machine_and_keeps_what_was_probed(run: Run, tmp_path: Path) -> None:
    heard: list[bytes] = []

    class Listening(DmeServer):
        def answer(self, data: bytes, moment: float) -> bytes:
            heard.append(data)
            return super().answer(data, moment)

    class Impatient(Notes):
        def note_probed(self, *_: object) -> None:
            raise KeyboardInterrupt

    path = small_path()
    with on_a_port(Listening(server(path).machine)) as port:
        keys = MachineKeys(host="127.0.0.1", port=port, timeout=PATIENCE)
        with pytest.raises(KeyboardInterrupt):
            run_probing(LiveProbing(path, keys, tmp_path / "raw.csv"), Impatient())
        awaited(lambda: b"AbortE" in b"".join(heard))
    assert b"".join(heard).endswith(b"E0001 AbortE()\r\n")
    assert len(rows(tmp_path / "raw.csv.part")) == 1
    assert [face for face, _, _ in run(server(path)).points] == [3, 4, 2]


def test_a_result_that_is_there_is_never_written_over(run: Run, tmp_path: Path) -> None:
    (tmp_path / "raw.csv").write_text("probed\n", encoding="ascii")
    with pytest.raises(AccessError, match="is there already; the gauge has been probed"):
        run(server(small_path()))
    assert (tmp_path / "raw.csv").read_text("ascii") == "probed\n"


def test_points_of_another_path_are_not_mixed_in(run: Run) -> None:
    with pytest.raises(AccessError):
        run(server(small_path(), collision=3))
    moved = planned(blocks=2, begin=(0.3, 0.21, 0.2))
    with pytest.raises(InputError, match="holds points of another path"):
        run(server(moved), moved)


def test_a_machine_that_corrects_the_radius_is_refused(run: Run) -> None:
    path = planned(blocks=2, radius_correction=True)
    with pytest.raises(InputError, match=r"I\+\+ DME reports centres of the tip"):
        run(server(path), path)


def test_a_server_that_is_not_there_is_said(tmp_path: Path) -> None:
    with on_a_port(server(small_path())) as port:
        pass
    probing = LiveProbing(small_path(), MachineKeys(host="127.0.0.1", port=port), tmp_path / "raw.csv")
    with pytest.raises(AccessError, match="the machine's server cannot be reached"):
        run_probing(probing, Notes())
