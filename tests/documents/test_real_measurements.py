"""What the page on real measurements says of all sets together, whichever way the directions are labelled."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import INSTALLED, model_of
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.plugin import MICROMETRE, MILLIMETRE, Axis, MeasurementSet

_DATA = Path(__file__).parents[1] / "data" / "published"
_Y = "ecmc_13e6c326"
#: The other linear sets; in none of them has an effect evidence of its own.
_OTHERS = ("ecmc_0657b0d4", "ecmc_1139bca6", "ecmc_2845f959", "ecmc_59b90437")


def _rows(name: str) -> list[tuple[float, int, int, float]]:
    """Return target, direction, run and deviation of each reading, mm and µm, in the order of the file."""
    lines = (_DATA / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    cells = [line.split(",") for line in lines if not line.startswith("#")][1:]
    return [(float(target), int(f"{sign}1"), int(run), float(x)) for target, sign, run, x in cells]


def _exchanged(rows: list[tuple[float, int, int, float]]) -> list[tuple[float, int, int, float]]:
    """Return the readings with their directions exchanged, in the order that the linear method then has."""
    turned = [(target, -direction, run, x) for target, direction, run, x in rows]
    return sorted(turned, key=lambda row: (row[2], -row[1], row[1] * row[0]))


def _diagnosis(rows: list[tuple[float, int, int, float]]) -> AxisDiagnosis:
    target, direction, run, deviation = (np.array(column) for column in zip(*rows, strict=True))
    positions, index = np.unique(target, return_inverse=True)
    measurements = MeasurementSet(
        Axis("X"), MILLIMETRE.to_si(positions), index, direction, run, MICROMETRE.to_si(deviation)
    )
    return diagnose(
        model_of("offset", "scale-error", "backlash"), make_observations_of(measurements), INSTALLED
    )


@pytest.mark.long
@pytest.mark.parametrize("name", _OTHERS)
def test_nothing_is_named_however_the_directions_are_labelled(name: str) -> None:
    rows = _rows(name)
    verdicts = [_diagnosis(each).verdict for each in (rows, _exchanged(rows))]
    assert verdicts == 2 * [DiagnosisVerdict.UNEXPLAINED]


@pytest.mark.long
def test_readings_that_stand_off_become_the_first_two_of_the_test() -> None:
    found = _diagnosis(_exchanged(_rows("ecmc_1139bca6")))
    assert found.outliers.tolist() == [0, 1]


@pytest.mark.long
def test_the_drift_of_y_leads_beside_what_is_irregular_and_is_named_with_the_labels_exchanged() -> None:
    rows = _rows(_Y)
    found = [_diagnosis(each) for each in (rows, _exchanged(rows))]
    assert [each.verdict for each in found] == [DiagnosisVerdict.UNEXPLAINED, DiagnosisVerdict.MISSING]
    for each in found:
        assert each.candidates[0].identifier == "thermal-drift"
        assert each.remainder is not None
        assert each.remainder.shape.en.startswith("irregular from position to position")
