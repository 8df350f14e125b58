"""Makes the measured files of this example: a simulated machine with known errors probes the gauge.

``python make.py`` writes initial-points.csv and probed.csv into this folder.
"""
# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from zlmreport.errors import Place
from zlmreport_step_gauge.calibration import cut_section, read_calibration

sys.path.append(str(Path(__file__).parents[2] / "tests"))
from step_gauge.simulated_cmm import MachineErrors, SimulatedTest, initial_points_csv, probed_csv, simulate

HERE = Path(__file__).parent
MACHINE = MachineErrors(
    scale=(18e-6, -9e-6, 12e-6),
    amplitude=(1.2e-6, 0.8e-6, 0.0),
    period=(0.12, 0.09, 0.1),
    lost_motion=(1.4e-6, 0.9e-6, 0.0),
    squareness=(15e-6, -8e-6, 4e-6),
)


def files() -> dict[str, str]:
    """Return the files by their names."""
    gauge = read_calibration(HERE / "gauge.yaml").gauge
    test = SimulatedTest(
        gauge=cut_section(gauge, 2, 13, Place("job.yaml")),
        begin=(0.120, 0.085, 0.195),
        direction=(0.85, 0.5, 0.06),
        temperature_difference=0.4,
        temperature_range=0.2,
    )
    simulated = simulate(test, MACHINE, np.random.Generator(np.random.PCG64(1994)))
    return {
        "initial-points.csv": initial_points_csv(simulated.initial_points),
        "probed.csv": probed_csv(simulated.coordinates, test.gauge),
    }


if __name__ == "__main__":
    for name, content in files().items():
        (HERE / name).write_text(content, encoding="utf-8")
