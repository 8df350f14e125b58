"""Makes the example fleet beside this file: ``python configs/fleet/make.py [FOLDER]``.

Every machine, laboratory and reading is invented. Of each axis there is a calibration a quarter: a job of a
few lines, and its readings as a wide table. Seeds are fixed: the same files come out again.
"""
# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

QUARTERS = ("2025-01", "2025-04", "2025-07", "2025-10", "2026-01", "2026-04", "2026-07", "2026-10")
TARGETS, RUNS = 11, 5
#: The readings of this job cannot be read: somebody's spreadsheet wrote a word where a number belongs.
BROKEN = "lt-250/c-2026-10"


@dataclass(frozen=True)
class Axis:
    """An axis: its errors in µm (″ on a rotary axis), and what grows from quarter to quarter.

    `scale` is the error over the whole travel, `wave` the amplitude of a periodic part, `backlash` the lost
    motion, `noise` of a reading; `growth` is added to the scale error in each quarter.
    """

    name: str
    travel: tuple[float, float]
    scale: float
    wave: float
    backlash: float
    noise: float
    limit: float
    growth: float = 0.0
    rotary: bool = False


@dataclass(frozen=True)
class Machine:
    """A machine: its folder, what all its jobs share, the first quarter, its axes."""

    folder: str
    manufacturer: str
    model: str
    serial: str
    language: str
    evaluate: str
    axes: tuple[Axis, ...]
    first: int = 3
    kind: str = "machine tool"


ISO = '{{standard: "iso230-2:2014", tolerances: {{A: {limit}}}}}'
ISO_2006 = '{{standard: "iso230-2:2006", tolerances: {{A: {limit}}}}}'
DGQ = "{{standard: vdi-dgq-3441, tolerances: {{P: {limit}}}}}"
VDE = "{{standard: vdi-vde-2617, tolerances: {{P: {limit}}}}}"
NMTBA = "{{standard: nmtba, tolerances: {{P: {limit}}}}}"
ENGLISH, GERMAN = "Example Machine Works", "Beispiel-Maschinenbau"

MACHINES = (
    Machine("mc-500", ENGLISH, "MC 500", "EX-101", "en", ISO, (
        Axis("X", (0, 500), 5.1, 0.8, 1.6, 0.35, 16),
        Axis("Y", (0, 400), -3.8, 0.6, 1.2, 0.30, 16),
        Axis("Z", (-450, 0), 4.4, 0.7, 2.1, 0.40, 16),
    )),
    # Its Y axis grows longer from quarter to quarter.
    Machine("mc-800", ENGLISH, "MC 800", "EX-102", "en", ISO, (
        Axis("X", (0, 800), 6.0, 1.0, 1.5, 0.40, 20),
        Axis("Y", (0, 650), 3.0, 0.9, 1.4, 0.35, 16, growth=1.15),
        Axis("Z", (-600, 0), -5.2, 0.8, 1.9, 0.40, 20),
        Axis("B", (-110, 110), 3.2, 0.9, 1.1, 0.35, 12, rotary=True),
        Axis("C", (0, 360), 2.6, 1.4, 0.9, 0.30, 12, rotary=True),
    ), first=0),
    Machine("lt-250", ENGLISH, "LT 250", "EX-103", "en", NMTBA, (
        Axis("X", (0, 260), 3.9, 0.7, 2.4, 0.35, 15),
        Axis("Z", (-900, 0), 7.2, 1.1, 1.8, 0.45, 20),
        Axis("C", (0, 360), 3.1, 1.2, 1.4, 0.40, 15, rotary=True),
    )),
    Machine("cm-7", "Example Metrology", "CM 7", "EX-104", "en", VDE, (
        Axis("X", (0, 700), 1.6, 0.3, 0.4, 0.12, 5),
        Axis("Y", (0, 1000), -1.9, 0.3, 0.3, 0.12, 5),
        Axis("Z", (-600, 0), 1.2, 0.2, 0.5, 0.14, 5),
    ), kind="coordinate measuring machine"),
    Machine("bz-630", GERMAN, "BZ 630", "EX-105", "de", DGQ, (
        Axis("X", (0, 630), 5.5, 0.9, 1.3, 0.40, 18),
        Axis("Y", (0, 560), 4.1, 0.8, 1.7, 0.35, 18),
        Axis("Z", (-500, 0), -4.6, 0.7, 1.5, 0.40, 18),
    )),
    # The limit of its X axis is not met.
    Machine("sm-300", GERMAN, "SM 300", "EX-106", "de", ISO_2006, (
        Axis("X", (0, 300), 9.4, 1.3, 1.8, 0.35, 9),
        Axis("Z", (0, 350), 2.4, 0.4, 0.8, 0.20, 9),
    )),
    Machine("rt-400", GERMAN, "RT 400", "EX-107", "de", DGQ, (
        Axis("C", (0, 360), 2.9, 1.6, 1.0, 0.35, 15, rotary=True),
    )),
    Machine("fm-1000", GERMAN, "FM 1000", "EX-108", "de", f"{ISO}\n  - {DGQ}", (
        Axis("X", (0, 1000), 7.7, 1.1, 1.6, 0.45, 25),
        Axis("Y", (0, 800), -6.3, 1.0, 1.9, 0.40, 25),
        Axis("Z", (-700, 0), 5.8, 0.9, 2.2, 0.45, 25),
        Axis("A", (-120, 30), 2.8, 0.7, 1.5, 0.40, 15, rotary=True),
        Axis("C", (0, 360), 3.3, 1.5, 1.2, 0.35, 15, rotary=True),
    )),
)  # fmt: skip

_MACHINE = """\
# What the jobs of one machine share. The machine is invented.
extends: ../../laboratory.yaml
certificate: {{language: {language}}}
customer: {{name: {customer}}}
machine: {{manufacturer: {manufacturer}, model: {model}, serial: {serial}, kind: {kind}}}
measurement:
  method: linear
  source: {{plugin: laser-csv, layout: wide}}
  remarks: {remarks}
instrument: {{name: {instrument}, serial: EXAMPLE-L-1, certificate: EXAMPLE-CAL-1, expanded_uncertainty: 0.5}}
environment: {{air_temperature: 20.1, material_temperature: 20.2}} # °C
"""

_JOB = """\
schema: zlmreport/job/1
extends: machine.yaml
certificate: {{number: EXAMPLE-{number}, kind: report, issued: {quarter}-20}}
axis: {{name: {axis}, kind: {kind}, travel: [{travel[0]:g}, {travel[1]:g}]}}
measurement: {{date: {quarter}-14, source: {{file: {stem}.csv}}}}
evaluate:
  - {evaluate}
"""


def main(folder: Path) -> None:
    """Write the fleet's jobs and readings into a folder."""
    for index, machine in enumerate(MACHINES):
        place = folder / machine.folder
        place.mkdir(parents=True, exist_ok=True)
        _write(place / "machine.yaml", _shared(machine))
        for number, axis in enumerate(machine.axes):
            random = np.random.default_rng([20261122, index, number])
            targets = _targets(axis, random)
            for quarter in range(machine.first, len(QUARTERS)):
                stem = f"{axis.name.lower()}-{QUARTERS[quarter]}"
                is_broken = f"{machine.folder}/{stem}" == BROKEN
                _write(place / f"{stem}.yaml", _job(machine, axis, quarter, stem))
                _write(place / f"{stem}.csv", _readings(axis, quarter, targets, random, is_broken=is_broken))


def _shared(machine: Machine) -> str:
    german = machine.language == "de"
    return _MACHINE.format(
        language=machine.language,
        customer="Beispielkunde GmbH" if german else "Example Customer Ltd",
        manufacturer=machine.manufacturer,
        model=machine.model,
        serial=machine.serial,
        kind=machine.kind,
        remarks="Simulierte Messwerte, keine Messung." if german else "Simulated readings, not measurements.",
        instrument="Laserinterferometer (Beispiel)" if german else "Laser interferometer (example)",
    )


def _job(machine: Machine, axis: Axis, quarter: int, stem: str) -> str:
    return _JOB.format(
        number=f"{machine.serial.removeprefix('EX-')}-{stem.upper()}",
        quarter=QUARTERS[quarter],
        axis=axis.name,
        kind="rotary" if axis.rotary else "linear",
        travel=axis.travel,
        stem=stem,
        evaluate=machine.evaluate.format(limit=axis.limit),
    )


def _targets(axis: Axis, random: np.random.Generator) -> np.ndarray:
    """Return targets: on a rotary axis each 30°, else at random fractions of their spacing."""
    first, last = axis.travel
    if axis.rotary:
        return np.arange(np.ceil(first / 30) * 30, last + 1, 30)
    fractions = (np.arange(TARGETS) + random.uniform(0.1, 0.9, TARGETS)) / TARGETS
    return np.round(first + fractions * (last - first), 1)


def _readings(
    axis: Axis, quarter: int, targets: np.ndarray, random: np.random.Generator, *, is_broken: bool
) -> str:
    """Return a table: one target a row, one column for each run and direction."""
    first, last = axis.travel
    fractions = (targets - first) / (last - first)
    scale = axis.scale + quarter * axis.growth + random.normal(0, 0.25 * axis.noise)
    mean = scale * (fractions - 0.5) + axis.wave * np.sin(2 * np.pi * 3 * fractions)
    rows = []
    for target, deviation in zip(targets, mean, strict=True):
        readings = deviation + random.normal(0, axis.noise, 2 * RUNS)
        readings[1::2] -= axis.backlash
        rows.append([f"{target:g}", *(f"{reading:.1f}" for reading in readings)])
    if is_broken:
        rows[6][4] = "overflow"
    heading = ["target", *(f"{run}{sign}" for run in range(1, RUNS + 1) for sign in "+-")]
    lines = [
        "# Simulated readings, not measurements.",
        "# Source: configs/fleet/make.py",
        *map(",".join, [heading, *rows]),
    ]
    return "".join(f"{line}\n" for line in lines)


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
