"""Every installed data source passes every check that a third party's author runs, on a file of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from environments import ROOT
from step_gauge.gauges import set_up
from zlmreport.plugin import CIRCLE, DISPLACEMENT, STRAIGHTNESS, Axis, AxisKind, NominalCircle, Place
from zlmreport.plugin.protocols import SourceContext
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import SOURCE_CHECKS, FileContents
from zlmreport_plugins.union_jack_lines import LINE
from zlmreport_step_gauge.calibration import read_calibration

REGISTRY = find_plugins()
DATA = ROOT / "tests" / "data" / "sources"
CONFIGS = ROOT / "configs"
GERMAN_COLUMNS = {"target": "Soll", "direction": "Richtung", "run": "Lauf", "deviation": "Abweichung"}
CALIBRATED = read_calibration(ROOT / "tests" / "data" / "step_gauge" / "stepgauge_cal.csv")
ON_A_GAUGE = SourceContext(
    Axis("Y"),
    Place("job.yaml", 1, 1),
    {"step_gauge": set_up(CALIBRATED.gauge, files=(CALIBRATED.file,))},
)
_Y_AXIS = FileContents(
    90, ((-15.0, "+", 1, 30.87), (20.0, "+", 5, -20.24), (15.0, "-", 1, 43.5), (-20.0, "-", 5, -7.93))
)
#: Read by a formula from distances and the calibration of the gauge: 20.0 mm is reached 2.2 µm short.
_ON_A_GAUGE = FileContents(
    20, ((20.0, "+", 1, -2.2314), (80.0, "+", 2, 2.4194), (30.0, "-", 1, -2.8904), (90.0, "-", 2, 1.4604))
)
ON_A_CIRCLE = Axis("XY", quantity=CIRCLE, circle=NominalCircle("XY", 0.15, 1 / 60))
#: Files that a source reads without complaint: its identifier, its job keys, the axis, and what it holds.
SAMPLES: list[tuple[str, Mapping[str, Any], Axis | SourceContext, FileContents]] = [
    (
        "ecmc",
        {"file": DATA / "ecmc_13e6c326.dat"},
        Axis("Y"),
        FileContents(
            90, ((-15.0, "+", 1, 19.88), (20.0, "+", 5, -27.57), (15.0, "-", 1, 63.44), (-20.0, "-", 5, 0.62))
        ),
    ),
    ("laser-csv", {"file": CONFIGS / "linear-axis" / "y-axis.csv"}, Axis("Y"), _Y_AXIS),
    (
        "laser-csv",
        {"file": CONFIGS / "german" / "x-achse.csv", "columns": GERMAN_COLUMNS},
        Axis("X"),
        FileContents(
            50, ((25.2, "+", 1, -0.97), (55.8, "+", 5, 44.86), (45.6, "-", 1, -25.54), (15.0, "-", 5, -22.08))
        ),
    ),
    (
        "laser-csv",
        {"file": CONFIGS / "rotary-axis" / "c-axis.csv"},
        Axis("C", AxisKind.ROTARY),
        FileContents(
            100,
            ((10.0, "+", 1, -20.52), (40.0, "+", 10, -3.6), (10.0, "-", 1, 111.6), (40.0, "-", 10, 115.92)),
        ),
    ),
    (
        "laser-csv-reversal",
        {"file": DATA / "straightness.csv", "reversed": DATA / "straightness-reversed.csv"},
        Axis("X", quantity=STRAIGHTNESS, error="EYX"),
        FileContents(6, ((0.0, "+", 1, 0.1), (200.0, "+", 1, 1.5), (0.0, "-", 1, 0.0), (100.0, "-", 1, 0.6))),
    ),
    (
        "circle-csv",
        {"file": CONFIGS / "machine" / "circle-xy.csv"},
        ON_A_CIRCLE,
        FileContents(720, ((0.5, "+", 1, 16.24), (0.5, "-", 1, 15.52), (90.5, "-", 1, -0.61))),
    ),
    (
        "channels-csv",
        {"file": CONFIGS / "drift" / "drift.csv"},
        Axis("Y2", quantity=DISPLACEMENT),
        FileContents(289, ((0.0, "+", 1, 20.16), (0.5, "+", 1, 20.04), (24.0, "+", 1, 22.07))),
    ),
    (
        "channels-csv",
        {
            "file": CONFIGS / "drift" / "drift-schicht.csv",
            "columns": {"time": "Zeit", "channel": "Kanal", "value": "Wert"},
            "channels": {"X": "Taster X1", "air_temperature": "Halle"},
        },
        Axis("X", quantity=DISPLACEMENT),
        FileContents(49, ((0.0, "+", 1, 12.42), (4.0, "+", 1, 14.37))),
    ),
    (
        "plate-csv",
        {"file": CONFIGS / "flatness" / "plate.csv", "foot": 100},
        Axis("W-E", quantity=LINE),
        FileContents(16, ((100.0, "+", 1, 5.16), (800.0, "+", 2, 6.70))),
    ),
    ("dcc", {"file": DATA / "y-axis.xml"}, Axis("Y"), _Y_AXIS),
    ("renishaw-rtl", {"file": DATA / "bidirectional.rtl"}, Axis("Y"), _Y_AXIS),
    (
        "serial-interferometer",
        {"journal": DATA / "linear.journal"},
        Axis("X"),
        FileContents(11, ((100.0, "+", 1, -2.3), (200.0, "+", 2, 4.7), (0.0, "-", 2, 1.1)), missing=1),
    ),
    (
        "step-gauge",
        {"file": ROOT / "tests" / "data" / "step_gauge" / "stepgauge_raw.csv"},
        ON_A_GAUGE,
        _ON_A_GAUGE,
    ),
    (
        "step-gauge",
        {"file": ROOT / "tests" / "data" / "step_gauge" / "stepgauge.res"},
        ON_A_GAUGE,
        _ON_A_GAUGE,
    ),
]


def name(value: object) -> str | None:
    """Return how a test names a sample: by its source and its file."""
    if not isinstance(value, Mapping):
        return None
    return next(each.name for each in value.values() if isinstance(each, Path))


@pytest.mark.parametrize("check", SOURCE_CHECKS)
@pytest.mark.parametrize(("identifier", "keys", "axis", "holds"), SAMPLES, ids=name)
def test_conforms(
    check: Callable[..., None],
    identifier: str,
    keys: Mapping[str, Any],
    axis: Axis | SourceContext,
    holds: FileContents,
) -> None:
    check(REGISTRY.source(identifier), keys, axis, holds)


def test_every_source_has_a_sample() -> None:
    installed = {source.identifier for source in REGISTRY.sources}
    assert installed == {identifier for identifier, *_ in SAMPLES}
