"""The loop closed on the real control: LinuxCNC's task, interpreter and motion, with its own tables.

LinuxCNC carries out the part program, headless and as an ordinary user, and what it tells the motor is
written down. An axis of our own, with a screw that errs, follows the motor before an emulated interferometer,
and the capture follows that axis in virtual time.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, sin
from pathlib import Path

import numpy as np

_MACHINE = Path(__file__).parent / "control"
_TABLE = "\nCOMP_FILE_TYPE = {kind}\nCOMP_FILE = table.comp\n"
#: How long a run may take, s, and how often it is tried: without real time the control may stumble.
_PATIENCE, _TRIES = 180.0, 3
#: The user without rights of its own that runs it for root: its real-time part refuses root.
_NOBODY = "nobody"
_UM, _MM = 1e-6, 1e-3
#: Of the control, s.
_CYCLE = 1e-3
JOB = """\
schema: zlmreport/job/1
certificate: {{number: {number}, kind: report}}
axis: {{name: X, travel: [0, 300], compensation_table: {table}}}
measurement:
  method: linear
  feed: 9000
  dwell: 1.5
  source:
    plugin: serial-interferometer
    instrument: {{plugin: umd2, port: '{port}'}}
    journal: {number}.journal
    dwell: 0.3
plan: {{targets: {{positions: {targets}}}, runs: 2, overrun: 5}}
evaluate: ["iso230-2:2014"]
model: {{effects: [offset, scale-error, backlash, {{periodic: {{period: 210}}}}]}}
compensation: {{controller: linuxcnc}}
"""
#: The axis rests for long beside what a reading takes: without real time the control hurries and tarries.
TARGETS = [0, 61.1, 118.7, 178.2, 239.8, 300]
BETWEEN = [30.6, 89.9, 148.5, 209.1, 269.9]


class DoesNotRunError(Exception):
    """LinuxCNC is installed, and does not run here."""


def is_here() -> bool:
    """Tell whether LinuxCNC is installed, and there is a user who may run it."""
    may_run = os.geteuid() != 0 or shutil.which("runuser") is not None
    return shutil.which("linuxcnc") is not None and may_run


def moved(folder: Path, program: str, table: Path | None = None, kind: int = 0) -> ScrewDriven:
    """Let LinuxCNC carry out a program, with a table or without, and return the axis that followed it.

    Raises
    ------
    DoesNotRunError
        If it does not come to its end, with what it said.
    """
    shutil.copytree(_MACHINE, folder)
    if table is not None:
        shutil.copy(table, folder / "table.comp")
        ini = folder / "machine.ini"
        ini.write_text(ini.read_text(encoding="ascii") + _TABLE.format(kind=kind), encoding="ascii")
    return ScrewDriven.behind(carried_out(folder, program))


def carried_out(folder: Path, program: str) -> Path:
    """Let the LinuxCNC of a folder carry out a program, and return what was written down of its motors.

    Raises
    ------
    DoesNotRunError
        If it does not come to its end, with what it said.
    """
    (folder / "program.ngc").write_text(program, encoding="ascii")
    for name in ("machine.tbl", "machine.var"):
        (folder / name).touch()
    command = ["linuxcnc", "-r", "machine.ini"]
    if os.geteuid() == 0:
        for each in (folder, *folder.iterdir()):
            shutil.chown(each, _NOBODY)
        command = ["runuser", "-u", _NOBODY, "--", "env", f"HOME={folder}", *command]  # it sets its own
    environment = {"HOME": str(folder), "PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C"}
    done = subprocess.run(
        command, cwd=folder, env=environment, timeout=_PATIENCE, capture_output=True, text=True, check=False
    )
    motor = folder / "motor.txt"
    if not motor.exists() or not motor.stat().st_size:
        raise DoesNotRunError(f"{done.stdout}{done.stderr}")
    return motor


@dataclass(frozen=True, slots=True)
class ScrewDriven:
    """An axis behind a motor: its screw has a wrong pitch, a wave and lost motion.

    Attributes
    ----------
    places
        Where it is in each cycle of the control, m.
    """

    places: list[float]

    @classmethod
    def behind(cls, motor: Path) -> ScrewDriven:
        """Return the axis that follows what was written down of a motor."""
        written = (np.loadtxt(motor) * _MM).tolist()
        carriage, places = written[0], []
        for told in written:
            carriage = min(max(carriage, told - _PLAY / 2), told + _PLAY / 2)
            places.append(carriage + screw(carriage))
        return cls(places)

    @property
    def duration(self) -> float:
        """When the program has ended, s."""
        return _CYCLE * len(self.places)

    def position(self, time: float) -> float:
        """Return where it is, m, at a time in s; it trembles, and rests before and after the program."""
        cycle = min(max(round(time / _CYCLE), 0), len(self.places) - 1)
        return self.places[cycle] + _TREMBLE * sin(cycle**2)


_PLAY, _TREMBLE = 12 * _UM, 0.05 * _UM


def screw(position: float) -> float:
    """Return by how much the screw errs, m."""
    turn = 2 * pi * position / 0.21
    return 160e-6 * position + 5 * _UM * sin(turn) - 2 * _UM * cos(turn)


def closed(
    folder: Path, port: str, run: Callable[..., str], capture: Callable[[Path, ScrewDriven], None]
) -> dict[str, float | str]:
    """Close the loop on LinuxCNC; return E of each test, µm, and what the confirmations say.

    Parameters
    ----------
    folder
        Where everything happens.
    port
        Of the interferometer.
    run
        Runs a command of the product, and returns what it prints.
    capture
        Captures the test of a job before an axis.
    """
    folder.chmod(0o755)  # for the user who runs LinuxCNC

    def test(number: str, table: str = "none", comp: Path | None = None, kind: int = 0) -> Path:
        """Plan, move and capture a test; return its job."""
        job = folder / f"{number}.yaml"
        targets = BETWEEN if number == "between" else TARGETS
        text = JOB.format(number=number, table=table, targets=targets, port=port)
        job.write_text(text, encoding="utf-8")
        run("plan", job, "--program", "linuxcnc", "--output", folder / "plan")
        program = (folder / "plan" / f"{number}.ngc").read_text(encoding="ascii")
        for attempt in range(_TRIES):
            axis = moved(folder / f"machine-{number}-{attempt}", program, comp, kind)
            job.with_suffix(".journal").unlink(missing_ok=True)
            try:
                capture(job, axis)
            except RuntimeError:
                if attempt == _TRIES - 1:
                    raise
            else:
                break
        return job

    def confirmed(job: Path, *options: str, held: bool = True) -> tuple[float, str]:
        found = json.loads(
            run("compensate", "--confirm", before, job, *options, "--json", expected=0 if held else 1)
        )
        return found["after"]["E"], found["verdict"]

    before = test("before")
    for kind in (0, 1):
        made = run("compensate", before, "--set", f"type={kind}", "-o", folder / f"type{kind}", "--json")
    expected = json.loads(made)["forecast"]
    run("compensate", before, "--controller", "csv", "--set", "decimals=6", "-o", folder / "csv")
    table = next((folder / "csv").glob("*.csv")).relative_to(folder).as_posix()
    comp = {kind: folder / f"type{kind}" / "before.comp" for kind in (0, 1)}
    turned = folder / "turned.comp"
    rows = np.loadtxt(comp[1])
    np.savetxt(turned, np.column_stack([rows[:, 0], -rows[:, 1:]]), fmt="%.6f")
    model = ["--from", "model", "--step", "10"]
    smooth = json.loads(run("compensate", before, *model, "-o", folder / "smooth", "--json"))["forecast"]
    found: dict[str, float | str] = {"before": expected["before"]["E"]}
    found["after type 0"], found["type 0"] = confirmed(test("type0", table, comp[0], 0))
    found["after type 1"], found["type 1"] = confirmed(test("type1", table, comp[1], 1))
    found["after turned"], found["turned"] = confirmed(test("turned", table, turned, 1), held=False)
    between = test("between", table, folder / "smooth" / "before.comp", 0)
    found["between"], found["between the rows"] = confirmed(between, *model)
    found["between forecast"] = smooth["between_grid_points"]["largest"]
    return found


def is_as_it_should_be(found: dict[str, float | str]) -> bool:
    """Tell whether the error fell to less than 1 % (and what the counter rounds), and a wrong sign shows."""
    before = float(found["before"])
    fell = all(float(found[f"after type {kind}"]) < 0.01 * before for kind in (0, 1))
    words = [found[name] for name in ("type 0", "type 1", "between the rows", "turned")]
    doubled = abs(float(found["after turned"]) / before - 2) < 0.02
    is_small_between = float(found["between"]) < 0.01 * before + 2 * float(found["between forecast"])
    return fell and doubled and is_small_between and words == ["held", "held", "held", "wrong-sign"]
