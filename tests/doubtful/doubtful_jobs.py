"""A sound calibration certificate of an axis of 1 m, to be spoilt as an assessor finds them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from document.certificate import documents
from zlmreport.plugin import InputError
from zlmreport.plugin.renderer import Certificate, EvaluatedParameter

#: Everything that an assessor could ask for is stated.
SOUND: Mapping[str, Any] = {
    "schema": "zlmreport/job/1",
    "certificate": {
        "number": "CAL-1",
        "issued": "2026-11-20",
        "authorised_by": {"name": "A. Person", "function": "Head"},
    },
    "laboratory": {"name": "Some Laboratory", "address": "Street 1, 12345 Town"},
    "customer": {"name": "A Customer", "address": "Lane 2, 54321 Village"},
    "machine": {"manufacturer": "Maker", "model": "M1", "serial": "S-1"},
    "location": {"kind": "customer"},
    "axis": {"name": "X", "travel": [0, 1000]},
    "measurement": {"date": "2026-11-18", "source": {"plugin": "laser-csv", "file": "x.csv"}},
    "instrument": {
        "name": "Laser interferometer",
        "certificate": "C-1",
        "calibrated": "2026-03-02",
        "expanded_uncertainty": 0.4,
        "compensation": "refractive index of the air",
    },
    "environment": {
        "air_temperature": 20.1,
        "axis_temperature": 20.0,
        "expansion_coefficient": 11.5,
        "thermometers": [{"name": "T 1", "certificate": "T-1", "calibrated": "2026-02-01"}],
    },
    "uncertainty": {
        "misalignment": 0.3,
        "machine_temperature": 0.1,
        "expansion_coefficient": 1,
        "environmental_variation": 1,
        "negligible": {
            "device_temperature": "laser, no length of its own",
            "device_expansion_coefficient": "laser, no length of its own",
        },
    },
    "evaluate": [{"standard": "iso230-2:2014", "tolerances": {"A": 10, "R": 5}}],
}

#: Deviations in µm, (target, direction, run), and the temperatures beside them, if any.
Readings = tuple[np.ndarray, np.ndarray | None]
TARGETS = np.array([3.1, 104.2, 201.7, 303.9, 398.3, 502.6, 601.4, 703.8, 799.2, 902.5, 996.4])
RUNS = 5


def order() -> list[tuple[int, int, int]]:
    """Return target, direction and run of each reading, in the order of the linear method."""
    count = len(TARGETS)
    return [
        (target, direction, run)
        for run in range(RUNS)
        for direction, targets in ((0, range(count)), (1, reversed(range(count))))
        for target in targets
    ]


def readings(scatter: float = 0.4, *, seed: int = 1, slope: float = 2.0, decimals: int = 2) -> np.ndarray:
    """Return deviations of an axis, µm: a slope (µm over the travel), a wave, a reversal of 0.8, a "
    "scatter."""
    generator = np.random.default_rng(seed)
    bow = slope * TARGETS / 1000 + 0.8 * np.sin(TARGETS / 160)
    true = bow[:, np.newaxis, np.newaxis] + np.array([0.4, -0.4])[:, np.newaxis]
    return np.round(true + scatter * generator.standard_normal((len(TARGETS), 2, RUNS)), decimals)


def write(folder: Path, deviations: np.ndarray, temperatures: np.ndarray | None = None) -> None:
    """Write the readings beside the job, with the temperature of the axis at each if it is known."""
    logged = "" if temperatures is None else ",axis_temperature"
    lines = [f"target,direction,run,deviation{logged}"]
    for number, (target, direction, run) in enumerate(order()):
        line = f"{TARGETS[target]},{'+-'[direction]},{run + 1},{deviations[target, direction, run]:.6g}"
        lines.append(line if temperatures is None else f"{line},{temperatures[number]:.3f}")
    (folder / "x.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


def changed(*changes: tuple[str, Any], of: Mapping[str, Any] = SOUND) -> dict[str, Any]:
    """Return the keys with others in the place of some: dotted keys with their values."""
    keys = dict(of)
    for dotted, value in changes:
        keys = documents.having(dotted, value, keys)
    return keys


def composed(
    folder: Path,
    keys: Mapping[str, Any],
    deviations: np.ndarray | None = None,
    trials: int = documents.FEW_TRIALS,
    **logged: Any,
) -> Certificate:
    """Return the document of a job on these readings."""
    write(folder, readings() if deviations is None else deviations, **logged)
    return documents.certificate(folder, keys, trials)


def refusals(
    folder: Path, keys: Mapping[str, Any], deviations: np.ndarray | None = None, **logged: Any
) -> str:
    """Return why a job is refused, as one text; empty if it is not."""
    try:
        composed(folder, keys, deviations, **logged)
    except InputError as error:
        return "\n".join(str(each) for each in error.problems)
    return ""


def cover(document: Certificate) -> str:
    """Return the first page as plain lines."""
    return "\n".join(line for block in document.cover for line in documents.lines_of(block))


def parameter(document: Certificate, symbol: str) -> EvaluatedParameter:
    """Return a result by the first standard."""
    found = document.evaluations[0].parameter(symbol)
    assert found is not None
    return found


REPORT = ("certificate.kind", "report")
Spoil = Callable[[np.ndarray], np.ndarray]
