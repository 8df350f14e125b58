"""Truth on a real control: LinuxCNC runs circles on a machine with known faults, and what is found of them.

    ./run benchmark machine-circles [--machines N] [--results FILE.jsonl]

The part programs are the product's own, of a circle at two feeds in both senses and of two axes. LinuxCNC's
task, interpreter and motion carry them out; its own ``pid`` closes the loop of each motor with a gain of its
own, and its own table acts in X. Behind the motors stands a machine with lost motion, unequal scales and an
angle between its axes; where its tool is becomes a table of a circle, and what axes stop at one of an axis.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import shutil
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

sys.path.append(str(Path(__file__).parent))
from on_linuxcnc import carried_out, is_here
from zlmreport.cli import main as zlmreport

_CONTROL = Path(__file__).parent
RADIUS, FEEDS = 100.0, (6000, 12000)  # mm, mm/min
_AXES = ("X", "Y")
_UM, _ARCSECOND = 1e-3, np.pi / 648000  # mm, rad
#: A reading each so many cycles of the control; how much a reading scatters, and what hangs together, mm.
_EVERY, _SCATTER, _HANGING = 10, 0.3 * _UM, 0.3 * _UM
#: A motor stands still that moves less in so many cycles, mm.
_STILL, _CYCLES = 1e-4, 60
_CIRCLE = """\
schema: zlmreport/job/1
certificate: {{number: circle-{feed}, kind: report}}
circle: {{plane: XY, radius: 100, feed: {feed}, centre: [0, 0, 0], calibrated_length: false}}
measurement: {{source: {{plugin: circle-csv, file: circle-{feed}.csv, feed_in: 90, feed_out: 90}}}}
plan: {{runs: 1, circle: {{arc: 90, rest: 0.5}}}}
evaluate: ["iso230-4:2005"]
"""
_AXIS = """\
schema: zlmreport/job/1
certificate: {{number: axis-{axis}, kind: report}}
axis: {{name: {axis}, travel: [-110, 110], compensation_table: none}}
measurement:
  feed: 12000
  dwell: 0.15
  at: {{{other}: 0}}
  source: {{plugin: laser-csv, file: axis-{axis}.csv}}
instrument: {{name: laser, expanded_uncertainty: 0.2}}
plan: {{targets: {{positions: [{positions}]}}, runs: 1, overrun: 1.5}}
evaluate: ["iso230-2:2014"]
"""
_MACHINE = """\
schema: zlmreport/machine/1
chain: XYFZ
errors: [{errors}]
tests: [{tests}]
model: {{effects: [centre-offset, radius]}}
"""


@dataclass(frozen=True, slots=True)
class Faults:
    """What is wrong with a machine.

    Attributes
    ----------
    gains
        Of the position loops of X and Y, 1/s.
    table
        Amplitude and period of what the control's table makes of X, mm.
    lost_motion, scales
        Of X and Y: mm, and mm/mm.
    square
        C0Y, rad: the Y axis turned towards −X.
    """

    gains: tuple[float, float] = (500.0, 357.0)
    table: tuple[float, float] = (3 * _UM, 50.0)
    lost_motion: tuple[float, float] = (6 * _UM, 3 * _UM)
    scales: tuple[float, float] = (25e-6, -15e-6)
    square: float = 5 * _ARCSECOND

    def tool(self, motors: np.ndarray) -> np.ndarray:
        """Return where the tool is, (N, 2), mm, as its motors go: carriages lag behind by their play."""
        carriages = np.column_stack(
            [_behind(told, play) for told, play in zip(motors.T, self.lost_motion, strict=True)]
        )
        places = carriages * (1.0 + np.array(self.scales))
        return np.column_stack([places[:, 0] - self.square * carriages[:, 1], places[:, 1]])

    def values(self) -> dict[str, float]:
        """Return what a diagnosis should find, in the units in which it prints: by effect and parameter."""
        times = [1e3 / gain for gain in self.gains]
        # A loop that adds the share g of its error in each cycle of 1 ms shrinks a circle by (1 − g)/g²·ω²/2.
        squares = [(1 - gain / 1e3) / (gain / 1e3) ** 2 for gain in self.gains]
        return {
            "servo-mismatch T_X-T_Y": times[0] - times[1],
            "servo-lag T²": float(np.mean(squares)),
            "squareness C0Y": self.square / _ARCSECOND,
            "scale-mismatch X-Y": 1e6 * (self.scales[0] - self.scales[1]),
            "circle-backlash X": self.lost_motion[0] / _UM,
            "circle-backlash Y": self.lost_motion[1] / _UM,
            "cyclic-error X": self.table[0] / _UM,
        }


def _behind(told: np.ndarray, play: float) -> np.ndarray:
    """Return where a carriage is that its motor takes along at the ends of its play."""
    found, at = np.empty(len(told)), float(told[0])
    for index, each in enumerate(told.tolist()):
        at = min(max(at, each - play / 2), each + play / 2)
        found[index] = at
    return found


@dataclass(frozen=True, slots=True)
class Recorded:
    """Where both motors were in each cycle of the control, (N, 2), mm."""

    circles: Mapping[int, np.ndarray]  #: By feed.
    lines: Mapping[str, np.ndarray]  #: By axis.


def targets_of(axis: str) -> np.ndarray:
    """Return where an axis stops, mm: X closely enough to follow its table."""
    return np.round(np.linspace(-110, 110, 41 if axis == "X" else 9), 1)


def record(folder: Path, faults: Faults) -> Recorded:
    """Let LinuxCNC, with these gains and this table, run the programs of the product in a new folder.

    Raises
    ------
    DoesNotRunError
        If it does not come to the end of one of them.
    """
    folder.mkdir()
    folder.chmod(0o755)  # for the user who runs LinuxCNC
    write_jobs(folder)
    motors = {}
    for name in (*(f"circle-{feed}" for feed in FEEDS), *(f"axis-{axis}" for axis in _AXES)):
        run("plan", folder / f"{name}.yaml", "--program", "linuxcnc", "--output", folder / "plan")
        control = folder / f"control-{name}"
        shutil.copytree(_CONTROL / "control_xy", control)
        shutil.copy(_CONTROL / "control" / "screen.py", control)
        ini = (control / "machine.ini").read_text(encoding="ascii")
        gains = dict(zip(("gain_x", "gain_y"), faults.gains, strict=True))
        (control / "machine.ini").write_text(ini.format(**gains), encoding="ascii")
        at = np.arange(-120.0, 120.1, 1.0)
        trim = faults.table[0] * np.sin(2 * np.pi * at / faults.table[1])
        np.savetxt(control / "table.comp", np.column_stack([at, trim, trim]), fmt="%.6f")
        motors[name] = np.loadtxt(carried_out(control, (folder / "plan" / f"{name}.ngc").read_text("ascii")))
    return Recorded(
        {feed: motors[f"circle-{feed}"] for feed in FEEDS}, {axis: motors[f"axis-{axis}"] for axis in _AXES}
    )


def write_jobs(folder: Path) -> None:
    """Write the jobs of circles and axes, and the machine file with the axes and without."""
    for feed in FEEDS:
        (folder / f"circle-{feed}.yaml").write_text(_CIRCLE.format(feed=feed), encoding="utf-8")
    for axis, other in (_AXES, _AXES[::-1]):
        positions = ", ".join(f"{each:g}" for each in targets_of(axis))
        text = _AXIS.format(axis=axis, other=other, positions=positions)
        (folder / f"axis-{axis}.yaml").write_text(text, encoding="utf-8")
    one_sense = (folder / f"circle-{FEEDS[0]}.yaml").read_text(encoding="utf-8").replace(".csv", "-ccw.csv")
    (folder / "circle-ccw.yaml").write_text(one_sense, encoding="utf-8")
    both = ", ".join(f"circle-{feed}.yaml" for feed in FEEDS)
    axes = ", ".join(f"axis-{axis}.yaml" for axis in _AXES)
    for name, errors, tests in (
        ("alone", "", both),
        ("with-axes", axes, both),
        ("one-sense", axes, "circle-ccw.yaml"),
    ):
        text = _MACHINE.format(errors=errors, tests=tests)
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")


def write_readings(folder: Path, seen: Recorded, faults: Faults, seed: int) -> None:
    """Write the tables of circles and axes, as a gauge reads the tool of a machine with faults."""
    draw = np.random.default_rng(seed)
    for feed, motors in seen.circles.items():
        rows = ["sense,run,angle,deviation"]
        for turn in turns_of(faults.tool(motors)):
            angle = np.degrees(np.unwrap(np.arctan2(turn[:, 1], turn[:, 0])))
            sense = "ccw" if angle[-1] > angle[0] else "cw"
            read = np.hypot(*turn.T) - RADIUS + _gauge(len(turn), draw)
            rows += [f"{sense},1,{one:.4f},{1e3 * other:.3f}" for one, other in zip(angle, read, strict=True)]
        for name, kept in (("", rows), ("-ccw", [each for each in rows if not each.startswith("cw")])):
            text = "\n".join(kept) + "\n"
            (folder / f"circle-{feed}{name}.csv").write_text(text, encoding="utf-8")
    for index, (axis, motors) in enumerate(seen.lines.items()):
        places = faults.tool(motors)[:, index]
        rows = ["target,direction,run,deviation"]
        for target, way, at in stops_of(motors[:, index], targets_of(axis)):
            read = places[at].mean() - target + 0.1 * _UM * draw.standard_normal()
            rows.append(f"{target:g},{way},1,{1e3 * read:.3f}")
        (folder / f"axis-{axis}.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")


def turns_of(tool: np.ndarray) -> Iterator[np.ndarray]:
    """Yield where the tool was in each turn, (n, 2): it comes from outside and leaves to there."""
    on = np.abs(np.hypot(*tool.T) - RADIUS) < 0.5
    edges = np.flatnonzero(np.diff(np.concatenate([[False], on, [False]]).astype(int)))
    for begin, end in edges.reshape(-1, 2).tolist():
        moving = np.hypot(*np.diff(tool[begin:end], axis=0).T) > _STILL
        turn = tool[begin : end - 1][moving][::_EVERY]
        if np.sum(np.hypot(*np.diff(turn, axis=0).T)) > 2 * np.pi * RADIUS:  # else it only passes the circle
            yield turn


def stops_of(motor: np.ndarray, targets: np.ndarray) -> Iterator[tuple[float, str, slice]]:
    """Yield each target at which an axis stops, the direction it came from, and the cycles of its rest."""
    still = np.abs(motor[_CYCLES:] - motor[:-_CYCLES]) < _STILL
    edges = np.flatnonzero(np.diff(np.concatenate([[False], still, [False]]).astype(int)))
    before = float(motor[0])
    for begin, end in edges.reshape(-1, 2).tolist():
        at = float(motor[begin + _CYCLES])
        target = float(targets[np.argmin(np.abs(targets - at))])
        if abs(target - at) < 0.1:
            yield target, "+" if at > before else "-", slice(begin + _CYCLES // 2, end + _CYCLES // 2)
        before = at


def _gauge(count: int, draw: np.random.Generator) -> np.ndarray:
    """Return what a gauge adds to its readings, mm: some of it hangs together along the path."""
    hanging, kept = np.zeros(count), 0.9
    own = draw.standard_normal(count)
    for index in range(1, count):
        hanging[index] = kept * hanging[index - 1] + np.sqrt(1 - kept**2) * own[index]
    return _SCATTER * draw.standard_normal(count) + _HANGING * hanging


@dataclass(frozen=True, slots=True)
class Found:
    """What a diagnosis came to.

    Attributes
    ----------
    named
        The effects that it found.
    values
        Of each fault that it gives a size: what was entered, what was found, its U, by effect and parameter.
    rms
        Of what the axes leave, what the effects leave beside them, and what scatters, µm.
    """

    named: list[str]
    values: dict[str, tuple[float, float, float]]
    rms: tuple[float, float, float]

    @property
    def misses(self) -> dict[str, float]:
        """Of each fault (found − entered)/U."""
        return {name: (found - entered) / u for name, (entered, found, u) in self.values.items()}


def diagnosed(folder: Path, name: str, faults: Faults) -> Found:
    """Return what the product finds in one of the machine files of a folder."""
    values = json.loads(run("machine", "diagnose", folder / f"{name}.yaml", "--json"))
    complete = values["complete"]
    return Found(
        values["set"],
        dict(_compared(complete["model"]["parameters"], faults.values())),
        (values["error"]["rms"], complete["error"]["rms"], complete["error"]["noise_rms"]),
    )


def _compared(
    parameters: list[dict[str, Any]], entered: Mapping[str, float]
) -> Iterator[tuple[str, tuple[float, float, float]]]:
    """Yield what was entered beside what was found and its U; of a wave its amplitude."""
    wave = {each["name"]: each for each in parameters if each["effect"] == "cyclic-error"}
    if {"X sin", "X cos"} <= wave.keys():
        sizes = [wave[name]["value"] for name in ("X sin", "X cos")]
        each_u = [wave[name]["expanded_uncertainty"] for name in ("X sin", "X cos")]
        amplitude = float(np.hypot(*sizes))
        u = float(np.hypot(*(size * own for size, own in zip(sizes, each_u, strict=True)))) / amplitude
        yield "cyclic-error X", (entered["cyclic-error X"], amplitude, u)
    for each in parameters:
        name = f"{each['effect']} {each['name']}".rstrip("+−")
        if name in entered and "expanded_uncertainty" in each:
            shown = f"{each['effect']} {each['name']}"
            yield shown, (entered[name], each["value"], each["expanded_uncertainty"])


def run(*arguments: Any) -> str:
    """Return what a command of the product prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        code = zlmreport(list(map(str, arguments)))
    if code:
        raise RuntimeError(
            f"zlmreport {' '.join(map(str, arguments))}: exit code {code}\n{printed.getvalue()}"
        )
    return printed.getvalue()


def is_as_it_should_be(found: Mapping[str, Found]) -> bool:
    """Tell whether the faults have their names, their sizes by 2 U, and hardly anything but noise is left.

    The lag that both drives share, and unequal scales beside drives that make an ellipse of a hundred times
    the noise, may stay within the noise; anything else may not.
    """
    alone, with_axes, one_sense = (set(found[name].named) for name in ("alone", "with-axes", "one-sense"))
    drives = {"servo-mismatch", "squareness"}
    right = (
        alone - {"servo-lag", "scale-mismatch"} == drives | {"circle-backlash", "cyclic-error"},
        with_axes - {"servo-lag"} == drives,
        not one_sense,
    )
    both = [found[name] for name in ("alone", "with-axes")]
    near = all(abs(miss) < 2.0 for each in both for miss in each.misses.values())
    return all(right) and near and _leaves_noise(found["with-axes"])


def _leaves_noise(found: Found) -> bool:
    """Tell whether what axes and effects leave is what scatters."""
    return found.rms[1] < 1.3 * found.rms[2]


def lines_of(found: Mapping[str, Found]) -> Iterator[str]:
    """Yield what was found in words."""
    for name, each in found.items():
        before, after, noise = each.rms
        named = ", ".join(each.named) or "nothing named"
        yield f"{name}: {before:.2f} µm to {after:.2f} µm, noise {noise:.2f} µm; {named}"
        for fault, (entered, seen, u) in each.values.items():
            yield f"  {fault:26}{entered:9.3f} entered {seen:9.3f} ± {u:.3f} found"


def of_one_machine(folder: Path, seen: Recorded, faults: Faults, seed: int) -> dict[str, Found]:
    """Write what gauges read of a machine, and return what is found with its axes and without."""
    write_readings(folder, seen, faults, seed)
    return {name: diagnosed(folder, name, faults) for name in ("alone", "with-axes", "one-sense")}


def drawn(draw: np.random.Generator, of_control: Faults | None = None) -> Faults:
    """Return faults: of control and mechanics, or of mechanics alone."""
    gains = tuple(float(each) for each in np.round(draw.uniform(300, 700, 2)))
    table = (float(draw.uniform(2, 5)) * _UM, float(draw.uniform(45, 65)))
    if of_control:
        gains, table = of_control.gains, of_control.table
    lost = tuple(float(each) * _UM for each in draw.uniform(1, 10, 2))
    scales = tuple(float(each) * 1e-6 for each in draw.uniform(-30, 30, 2))
    square = float(draw.choice([-1, 1]) * draw.uniform(1.5, 8)) * _ARCSECOND
    return Faults((gains[0], gains[1]), table, (lost[0], lost[1]), (scales[0], scales[1]), square)


def main(arguments: Sequence[str]) -> None:
    """Draw controls and machines behind them, and print how many faults came out within their U."""
    parser = argparse.ArgumentParser(
        prog="./run benchmark machine-circles", description=__doc__.splitlines()[0]
    )
    parser.add_argument(
        "--controls", type=int, default=2, help="gains and tables, each run once (%(default)s)"
    )
    parser.add_argument("--machines", type=int, default=5, help="behind each of them (%(default)s)")
    parser.add_argument(
        "--results", type=Path, metavar="FILE", help="a line for each machine and machine file"
    )
    options = parser.parse_args(arguments)
    if not is_here():
        sys.exit("LinuxCNC is not installed (Debian's package linuxcnc-uspace)")
    draw = np.random.default_rng(1)
    misses: dict[str, list[float]] = {}
    for control in range(options.controls):
        of_control = drawn(draw)
        with TemporaryDirectory() as name:
            Path(name).chmod(0o755)
            folder = Path(name) / "machine"
            seen = record(folder, of_control)
            for machine in range(options.machines):
                faults = drawn(draw, of_control)
                for plan, found in of_one_machine(folder, seen, faults, machine).items():
                    line = {"control": control, "machine": machine, "plan": plan, **asdict(found)}
                    for fault, miss in found.misses.items():
                        misses.setdefault(f"{plan}: {fault.rstrip('+−')}", []).append(miss)
                    if options.results:
                        with options.results.open("a", encoding="utf-8") as file:
                            file.write(json.dumps(line, ensure_ascii=False) + "\n")
                    print(
                        json.dumps({key: line[key] for key in ("control", "machine", "plan", "named")}),
                        flush=True,
                    )
    for name, own in misses.items():
        print(f"{name}: {sum(abs(each) <= 1 for each in own)} of {len(own)} within U")
