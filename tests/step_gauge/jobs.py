"""Jobs with a step gauge that lies anywhere, as files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from replacing import replaced
from step_gauge.paths import ORIENTATIONS

_RADIUS = 2.0
_JOB = """\
schema: zlmreport/job/1
certificate: {number: CMM-7, kind: report}
axis: {name: Y}
measurement:
  source: {plugin: step-gauge, file: raw.csv}
evaluate: [iso230-2:2014]
step_gauge:
  calibration: gauge.csv
  initial_points: points.csv
  tip_radius: 2
  path: {cycles: 2, clearance: 3, safe_position: [0, 0, 400]}
"""


def job_text(*changes: tuple[str, str]) -> str:
    """Return the text of the job with some of it replaced."""
    return replaced(_JOB, *changes)


def write_job(folder: Path, *changes: tuple[str, str], blocks: int = 3, orientation: str = "y") -> Path:
    """Write a job and its files: blocks of 10 mm every 20 mm, the first centred at (300, 200, 200) mm."""
    rows = [
        f"{face},{'front' if face % 2 else 'back'},{10 * (face - 1)}.000,{10 * (face - 1)}.00000,0.20"
        for face in range(1, 2 * blocks + 1)
    ]
    table = ["face,side,nominal_mm,calibrated_mm,U_k2_um", *rows]
    (folder / "gauge.csv").write_text("\n".join(table) + "\n", encoding="ascii")
    points = [
        "block,point,x,y,z",
        *_points("begin", 0, orientation),
        *_points("end", blocks - 1, orientation),
    ]
    (folder / "points.csv").write_text("\n".join(points) + "\n", encoding="ascii")
    job = folder / "job.yaml"
    job.write_text(job_text(*changes), encoding="utf-8")
    return job


def _points(name: str, index: int, orientation: str) -> list[str]:
    """Return the eight points on a block: centres of the tip."""
    along, upward = (np.array(each) for each in ORIENTATIONS[orientation])
    across = np.cross(along, upward)
    centre = np.array([300.0, 200.0, 200.0]) + 20 * index * along
    reach = 5 + _RADIUS
    points = [
        centre - reach * along + 3 * across - 2 * upward,
        centre - reach * along - 3 * across - 2 * upward,
        centre - reach * along + 3 * upward,
        centre + reach * across,
        centre - reach * across,
        centre + reach * upward,
        centre - 10 * along + (_RADIUS - 5) * upward,
        centre + reach * along,
    ]
    return [
        ",".join([name, str(number), *(f"{each:.6f}" for each in point.tolist())])
        for number, point in enumerate(points, start=1)
    ]
