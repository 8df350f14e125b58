"""Every installed data source passes every check that a third party's author runs, on a file of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from environments import ROOT
from zlmreport.errors import Place
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.plugin.protocols import SourceContext
from zlmreport.plugins import find_plugins
from zlmreport.testing import SOURCE_CHECKS
from zlmreport_step_gauge.calibration import read_calibration
from zlmreport_step_gauge.set_up import GaugeSetUp

REGISTRY = find_plugins()
DATA = ROOT / "tests" / "data" / "sources"
CONFIGS = ROOT / "configs"
GERMAN_COLUMNS = {"target": "Soll", "direction": "Richtung", "run": "Lauf", "deviation": "Abweichung"}
CALIBRATED = read_calibration(ROOT / "tests" / "data" / "step_gauge" / "stepgauge_cal.csv")
ON_A_GAUGE = SourceContext(
    Axis("Y"),
    Place("job.yaml", 1, 1),
    {
        "step_gauge": GaugeSetUp(
            gauge=CALIBRATED.gauge,
            located=None,
            tip_radius=2e-3,
            radius_is_corrected=False,
            effective_radius=None,
            probing_uncertainty=0.0,
            gauge_expansion=None,
            scale_expansion=None,
            files=(CALIBRATED.file,),
            place=Place("job.yaml", 1, 1),
        )
    },
)
#: Files that a source reads without complaint: its identifier, its job keys, and the axis.
SAMPLES: list[tuple[str, Mapping[str, Any], Axis | SourceContext]] = [
    ("ecmc", {"file": DATA / "ecmc_13e6c326.dat"}, Axis("Y")),
    ("laser-csv", {"file": CONFIGS / "linear-axis" / "y-axis.csv"}, Axis("Y")),
    ("laser-csv", {"file": CONFIGS / "german" / "x-achse.csv", "columns": GERMAN_COLUMNS}, Axis("X")),
    ("laser-csv", {"file": CONFIGS / "rotary-axis" / "c-axis.csv"}, Axis("C", AxisKind.ROTARY)),
    ("renishaw-rtl", {"file": DATA / "bidirectional.rtl"}, Axis("Y")),
    ("serial-interferometer", {"journal": DATA / "linear.journal"}, Axis("X")),
    ("step-gauge", {"file": ROOT / "tests" / "data" / "step_gauge" / "stepgauge_raw.csv"}, ON_A_GAUGE),
    ("step-gauge", {"file": ROOT / "tests" / "data" / "step_gauge" / "stepgauge.res"}, ON_A_GAUGE),
]


def name(value: object) -> str | None:
    """Return how a test names a sample: by its source and its file."""
    if not isinstance(value, Mapping):
        return None
    return next(each.name for each in value.values() if isinstance(each, Path))


@pytest.mark.parametrize("check", SOURCE_CHECKS)
@pytest.mark.parametrize(("identifier", "keys", "axis"), SAMPLES, ids=name)
def test_conforms(
    check: Callable[..., None], identifier: str, keys: Mapping[str, Any], axis: Axis | SourceContext
) -> None:
    check(REGISTRY.source(identifier), keys, axis)


def test_every_source_has_a_sample() -> None:
    installed = {source.identifier for source in REGISTRY.sources}
    assert installed == {identifier for identifier, *_ in SAMPLES}
