"""The error falls on the machine: plan, program, capture, table, second run, confirmed; in virtual time.

The commands are the product's own, and so are ports, decoders and journals. The machine carries out the plan
and errs as described below; with a table in its control it errs by so much less as the table takes away.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from zlmreport.cli import main as zlmreport
from zlmreport.job.simulation import load_simulation
from zlmreport.live.emulation.emulator import Scene
from zlmreport.model.simulation.files import read_description_of
from zlmreport.model.simulation.simulate import EmulatedMachine, make_emulated_machine
from zlmreport.plugin.registry import find_plugins

sys.path.append(str(Path(__file__).parents[1] / "tests"))
sys.path.append(str(Path(__file__).parent))
import circles_on_linuxcnc
import on_linuxcnc
from live.capture.virtual import PORT, World, inhabited

_ROOT = Path(__file__).parents[1]
EXAMPLE = _ROOT / "configs" / "closed-loop"
#: How long the machine waits at the datum, s.
_LEAD = 5.0
#: What the machine really does; its table, if it has one, acts by a factor: −1 as it should.
_MACHINE = """\
schema: zlmreport/simulation/1
seed: {seed}
axis: {{name: X, travel: [0, 300]{table}}}
targets: {{positions: [0, 27.3, 61.1, 92.4, 118.7, 151.9, 178.2, 213.5, 239.8, 268.4, 300]}}
runs: 5
overrun: 5
feed: 6000
dwell: 0.6
effects:
  - scale-error: {{slope: 160}}
  - backlash: {{lost_motion: -12}}
  - periodic: {{period: 210, sine: 5, cosine: -2}}
{acting}noise: {{reading: 0.2}}
"""
_ACTING = "  - compensation-sign: {{factor: {factor}}}\n"


@dataclass(frozen=True, slots=True)
class Loop:
    """What a closed loop came to, µm.

    Attributes
    ----------
    before, forecast, after
        E of the first test, what a second one was forecast to show (low, high), and what it showed.
    verdict
        Of the confirmation, and of one with the wrong sign.
    """

    before: float
    forecast: tuple[float, float]
    after: float
    verdict: str
    wrong: str
    wrong_after: float


def closed(folder: Path) -> Loop:
    """Close the loop on a copy of the example in a folder.

    Raises
    ------
    RuntimeError
        If a command does not do what it should.
    """
    for name in ("before.yaml", "after.yaml"):
        text = (EXAMPLE / name).read_text(encoding="utf-8").replace("port: interferometer", f"port: '{PORT}'")
        (folder / name).write_text(text, encoding="utf-8")
    before, after = folder / "before.yaml", folder / "after.yaml"
    _run("plan", before, "--program", "linuxcnc", "--output", folder / "plan")
    _captured(before, _MACHINE.format(seed=1, table="", acting=""))
    made = json.loads(_run("compensate", before, "--output", folder / "table", "--json"))
    _run("compensate", before, "--controller", "csv", "--set", "decimals=4", "--output", folder / "csv")
    shutil.copy(next((folder / "csv").glob("*.csv")), folder / "table.csv")
    _captured(after, _with_table(2, -1))
    found = json.loads(_run("compensate", "--confirm", before, after, "--json"))
    wrong = folder / "wrong.yaml"
    text = after.read_text(encoding="utf-8").replace("after.journal", "wrong.journal")
    wrong.write_text(text, encoding="utf-8")
    _captured(wrong, _with_table(3, 1))
    turned = json.loads(_run("compensate", "--confirm", before, wrong, "--json", expected=1))
    expected, systematic = made["forecast"]["second_test"]["E"], made["forecast"]["before"]["E"]
    return Loop(
        systematic,
        (expected["low"], expected["high"]),
        systematic * found["ratio"],
        found["verdict"],
        turned["verdict"],
        systematic * turned["ratio"],
    )


def _with_table(seed: int, factor: int) -> str:
    acting = _ACTING.format(factor=factor)
    return _MACHINE.format(seed=seed, table=", compensation_table: table.csv", acting=acting)


def _captured(job: Path, machine: str) -> None:
    """Let a machine carry out its plan, and capture it."""
    path = job.with_name("machine.yaml")
    path.write_text(machine, encoding="utf-8")
    registry = find_plugins()
    description = read_description_of(load_simulation(path, registry), registry.effect)
    _capture(job, make_emulated_machine(description, _LEAD))


def _capture(job: Path, moving: EmulatedMachine | on_linuxcnc.ScrewDriven) -> None:
    """Capture a test before what moves."""
    emulator = find_plugins().instrument("umd2").emulator(Scene(moving))
    with inhabited(World(emulator, moving.duration + 2 * _LEAD)):
        _run("capture", job)


def _run(*arguments: Any, expected: int = 0) -> str:
    """Return what a command prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        code = zlmreport(list(map(str, arguments)))
    if code != expected:
        message = f"zlmreport {' '.join(map(str, arguments))}: exit code {code}\n{printed.getvalue()}"
        raise RuntimeError(message)
    return printed.getvalue()


def _on_linuxcnc() -> int:
    """Close the loop on LinuxCNC; return 1 if it does not do what it should."""
    if not on_linuxcnc.is_here():
        print("skipped: LinuxCNC is not installed (Debian's package linuxcnc-uspace)")
        return 0
    with TemporaryDirectory() as name:
        try:
            found = on_linuxcnc.closed(Path(name), PORT, _run, _capture)
            for key, value in found.items():
                print(f"{key:20}{value:8.2f} µm" if isinstance(value, float) else f"{key:20}{value}")
            faults, folder = circles_on_linuxcnc.Faults(), Path(name) / "plane"
            seen = circles_on_linuxcnc.record(folder, faults)
        except on_linuxcnc.DoesNotRunError as error:
            print(f"skipped: LinuxCNC does not run here:\n{error}")
            return 0
        circles = circles_on_linuxcnc.of_one_machine(folder, seen, faults, seed=1)
    print(*circles_on_linuxcnc.lines_of(circles), sep="\n")
    is_right = on_linuxcnc.is_as_it_should_be(found) and circles_on_linuxcnc.is_as_it_should_be(circles)
    return 0 if is_right else 1


def main(arguments: list[str] | None = None) -> int:
    """Close the loop, and say what came of it."""
    parser = argparse.ArgumentParser(prog="./run closed-loop", description=__doc__)
    parser.add_argument("--record", type=Path, metavar="DIR", help="leave journals and table in a folder")
    parser.add_argument("--on-linuxcnc", action="store_true", help="then on the real control, too: 8 minutes")
    options = parser.parse_args(arguments)
    record = options.record
    with TemporaryDirectory() as name:
        folder = Path(name)
        loop = closed(folder)
        if record:
            for kept in ("before.journal", "after.journal", "table.csv"):
                shutil.copy(folder / kept, record / kept)
    low, high = loop.forecast
    print(f"E without a table       {loop.before:8.2f} µm")
    print(f"E that was forecast     {low:8.2f} to {high:.2f} µm")
    print(f"E with the table        {loop.after:8.2f} µm  {loop.verdict}")
    print(f"E with the wrong sign   {loop.wrong_after:8.2f} µm  {loop.wrong}", flush=True)
    return _on_linuxcnc() if options.on_linuxcnc else 0


if __name__ == "__main__":
    sys.exit(main())
