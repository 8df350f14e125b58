"""The job that is measured: 21 target positions, both directions, five runs, two standards."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

TARGETS = 21
RUNS = 5

_JOB = """\
schema: zlmreport/job/1
certificate:
  number: {number}
  layout: {layout}
  issued: 2026-11-20
  authorised_by: {{name: Erika Example, function: Head of laboratory}}
laboratory:
  name: Example Calibration Laboratory
  address: Example Street 1, 12345 Exampletown
  accreditation: none (example)
customer: {{name: Example Customer Ltd, address: "Example Lane 2, 12345 Exampletown"}}
location: {{kind: customer}}
machine: {{manufacturer: Example Machine Works, model: HMC 500, serial: EXAMPLE-4711}}
axis: {{name: X, travel: [0, 1000], screw_pitch: 10}}
measurement:
  date: 2026-11-18
  method: linear
  feed: 2000
  source: {{plugin: laser-csv, file: {number}.csv}}
instrument:
  name: Laser interferometer
  certificate: EXAMPLE-CAL-1
  expanded_uncertainty: 0.5
  compensates: {{air: true}}
uncertainty:
  misalignment: 0.2
  machine_temperature: 0.3
  expansion_coefficient: 2
  environmental_variation: 0.2
  negligible:
    device_temperature: a laser has no length of its own
    device_expansion_coefficient: a laser has no length of its own
environment:
  axis_temperature: 20.3
  expansion_coefficient: 11.5
  air_temperature: 20.1
  air_pressure: 1013.2
  relative_humidity: 48
evaluate:
  - {{standard: "iso230-2:2014", tolerances: {{A: 20, E: 15, M: 12, R: 8, B: 5}}}}
  - {{standard: vdi-dgq-3441, tolerances: {{P: 20, Pa: 12, Ps_max: 8, U_max: 5}}}}
output: {{formats: [pdf]}}
"""


def write_job(folder: Path, number: str, layout: str = "full") -> Path:
    """Write a job and its readings, simulated; another number gives other readings."""
    rows = ["target,direction,run,deviation", *_readings(random.Random(number))]
    (folder / f"{number}.csv").write_text("\n".join(rows), encoding="utf-8")
    job = folder / f"{number}.yaml"
    job.write_text(_JOB.format(number=number, layout=layout), encoding="utf-8")
    return job


def _readings(scatter: random.Random) -> Iterator[str]:
    """Yield the rows in the order of the linear method: in each run all targets upwards, then downwards."""
    targets = [10 + 49 * index + scatter.choice((-1.5, -0.5, 0.5, 1.5)) for index in range(TARGETS)]
    for run in range(1, RUNS + 1):
        for sign, order in (("+", targets), ("-", targets[::-1])):
            for target in order:
                mean = 0.006 * target + 2.5 * math.sin(target / 120) + (1.2 if sign == "+" else -1.2)
                yield f"{target},{sign},{run},{mean + scatter.gauss(0, 0.5):.2f}"
