"""Every installed data source passes every check that a third party's author runs, on a file of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from environments import ROOT
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.plugins import find_plugins
from zlmreport.testing import SOURCE_CHECKS

REGISTRY = find_plugins()
DATA = ROOT / "tests" / "data" / "sources"
CONFIGS = ROOT / "configs"
GERMAN_COLUMNS = {"target": "Soll", "direction": "Richtung", "run": "Lauf", "deviation": "Abweichung"}
#: Files that a source reads without complaint: its identifier, its job keys, and the axis.
SAMPLES: list[tuple[str, Mapping[str, Any], Axis]] = [
    ("ecmc", {"file": DATA / "ecmc_13e6c326.dat"}, Axis("Y")),
    ("laser-csv", {"file": CONFIGS / "linear-axis" / "y-axis.csv"}, Axis("Y")),
    ("laser-csv", {"file": CONFIGS / "german" / "x-achse.csv", "columns": GERMAN_COLUMNS}, Axis("X")),
    ("laser-csv", {"file": CONFIGS / "rotary-axis" / "c-axis.csv"}, Axis("C", AxisKind.ROTARY)),
    ("renishaw-rtl", {"file": DATA / "bidirectional.rtl"}, Axis("Y")),
]


def name(value: object) -> str | None:
    """Return how a test names a sample: by its source and its file."""
    return Path(value["file"]).name if isinstance(value, Mapping) else None


@pytest.mark.parametrize("check", SOURCE_CHECKS)
@pytest.mark.parametrize(("identifier", "keys", "axis"), SAMPLES, ids=name)
def test_conforms(check: Callable[..., None], identifier: str, keys: Mapping[str, Any], axis: Axis) -> None:
    check(REGISTRY.source(identifier), keys, axis)


def test_every_source_has_a_sample() -> None:
    installed = {source.identifier for source in REGISTRY.sources}
    assert installed == {identifier for identifier, *_ in SAMPLES}
