"""Two tables of one line, the artefact turned over: the axis alone is left."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from installed import registry
from zlmreport.plugin import (
    Axis,
    InputError,
    Language,
    MeasurementSet,
    Place,
    error_named,
)
from zlmreport.plugin.protocols import SourceContext

POSITIONS = np.arange(0.0, 601.0, 100.0)
AXIS = 2e-5 * POSITIONS * (600.0 - POSITIONS) + 0.004 * POSITIONS
MIRROR = 0.7 * np.sin(POSITIONS / 90.0)
STRAIGHTNESS = Axis("X", quantity=error_named("EYX").measurand, error="EYX")


def table(folder: Path, name: str, values: np.ndarray, order: int = 1) -> Path:
    """Write one run up, and one down with 0.2 µm of reversal; `order` −1 writes the rows the other way."""
    rows = [f"{at:g},+,1,{value:.5f}" for at, value in zip(POSITIONS, values, strict=True)]
    rows += [f"{at:g},-,1,{value - 0.2:.5f}" for at, value in zip(POSITIONS, values, strict=True)]
    path = folder / name
    path.write_text("\n".join(["target,direction,run,deviation", *rows[::order]]) + "\n", encoding="utf-8")
    return path


def read(folder: Path, axis: Axis = STRAIGHTNESS, order: int = 1, **keys: Any) -> MeasurementSet:
    source = registry().source("laser-csv-reversal")
    first = table(folder, "first.csv", AXIS + MIRROR)
    second = table(folder, "second.csv", AXIS - MIRROR + 0.001 * POSITIONS, order)
    options = source.options.model_validate({"file": first, "reversed": second, **keys})
    return source.read(options, SourceContext(axis, Place("job.yaml", 3, 1)))


def test_the_mirror_drops_out_and_alignments_are_averaged(tmp_path: Path) -> None:
    found = read(tmp_path).deviations()[0, :, 0]
    assert found * 1e6 == pytest.approx(AXIS + 0.0005 * POSITIONS, abs=1e-4)


def test_the_order_of_the_second_table_does_not_matter(tmp_path: Path) -> None:
    np.testing.assert_allclose(read(tmp_path, order=-1).deviations(), read(tmp_path).deviations())


def test_both_files_are_named_and_the_mirror_s_own_straightness_is_told(tmp_path: Path) -> None:
    found = read(tmp_path)
    assert [each.name for each in found.provenance.files] == ["first.csv", "second.csv"]
    assert found.artefact_is_reversed
    x, tilted = POSITIONS - POSITIONS.mean(), MIRROR - 0.0005 * POSITIONS
    own = np.ptp(tilted - x * (x @ tilted) / (x @ x))
    assert f"{own:.3g}" in found.provenance.remarks[0].in_language(Language.ENGLISH)


def test_a_second_table_of_another_plan_is_refused(tmp_path: Path) -> None:
    other = tmp_path / "other.csv"
    other.write_text("target,direction,run,deviation\n0,+,1,0\n50,+,1,0\n100,+,1,0\n", encoding="utf-8")
    with pytest.raises(InputError, match="target positions are not those of first"):
        read(tmp_path, reversed=other)


@pytest.mark.parametrize("symbol", ["EXX", "EBX"])
def test_only_a_straightness_is_reversed(tmp_path: Path, symbol: str) -> None:
    axis = Axis("X", quantity=error_named(symbol).measurand, error=symbol)
    with pytest.raises(InputError, match="names one, such as EYX"):
        read(tmp_path, axis)
