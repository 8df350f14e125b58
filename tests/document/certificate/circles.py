"""Documents on a small circle: some turns in each sense, 8° from angle to angle."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from document.certificate.documents import COMPLETE, certificate, job
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import Certificate

CIRCLE = {"plane": "ZX", "radius": 100, "feed": 500, "centre": [250, 200, 120], "calibrated_length": True}


def written(folder: Path, turns: Mapping[str, int]) -> str:
    """Write a circle with so many turns in each sense, 8° apart, and return the name of its file."""
    rows = [
        f"{sense},{run},{angle},{2 * np.sin(np.radians(2 * angle)):.2f}"
        for sense, count in turns.items()
        for run in range(1, count + 1)
        for angle in np.arange(0, 360, 8)[:: 1 if sense == "ccw" else -1]
    ]
    (folder / "circle.csv").write_text("\n".join(["sense,run,angle,deviation", *rows]))
    return "circle.csv"


def keys_of(
    folder: Path, turns: Mapping[str, int], circle: Mapping[str, Any] = CIRCLE, **of_certificate: Any
) -> dict[str, Any]:
    """Return the keys of a report on a circle, whose file is written into a folder."""
    return {
        **{key: each for key, each in COMPLETE.items() if key not in {"axis", "uncertainty"}},
        "certificate": {**COMPLETE["certificate"], "kind": "report", **of_certificate},
        "laboratory": {**COMPLETE["laboratory"], "country": "DE"},
        "circle": circle,
        "measurement": {
            "date": "2022-04-07",
            "source": {"plugin": "circle-csv", "file": written(folder, turns)},
        },
        "evaluate": ["iso230-4:2005"],
    }


def document(
    folder: Path, turns: Mapping[str, int], circle: Mapping[str, Any] = CIRCLE, **of_certificate: Any
) -> Certificate:
    """Return the report."""
    return certificate(folder, keys_of(folder, turns, circle, **of_certificate))


def report(folder: Path, turns: Mapping[str, int], **changed: Any) -> Job:
    """Return the job of the report, keys changed."""
    return job(folder, {**keys_of(folder, turns), **changed})
