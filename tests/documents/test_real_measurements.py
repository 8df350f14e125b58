"""What the page on real measurements says of all sets together, whichever way the directions are labelled."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import INSTALLED, model_of
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.fitting.observations import make_observations_of

_DATA = Path(__file__).parents[1] / "data" / "published"
VERDICTS = {
    "ecmc_13e6c326": DiagnosisVerdict.MISSING,
    "ecmc_0657b0d4": DiagnosisVerdict.UNEXPLAINED,
    "ecmc_1139bca6": DiagnosisVerdict.UNEXPLAINED,
    "ecmc_2845f959": DiagnosisVerdict.UNEXPLAINED,
    "ecmc_59b90437": DiagnosisVerdict.UNEXPLAINED,
}


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
        Axis("X"),
        MILLIMETRE.to_si(positions),
        index,
        direction,
        run,
        MICROMETRE.to_si(deviation),
    )
    return diagnose(
        model_of("offset", "scale-error", "backlash"), make_observations_of(measurements), INSTALLED
    )


@pytest.mark.long
@pytest.mark.parametrize("name", VERDICTS)
def test_no_verdict_rests_on_the_labels_of_the_directions(name: str) -> None:
    rows = _rows(name)
    assert [_diagnosis(each).verdict for each in (rows, _exchanged(rows))] == 2 * [VERDICTS[name]]


@pytest.mark.long
def test_readings_that_stand_off_become_the_first_two_of_the_test() -> None:
    found = _diagnosis(_exchanged(_rows("ecmc_1139bca6")))
    assert found.outliers.tolist() == [0, 1]


@pytest.mark.long
def test_the_drift_of_y_is_named_beside_what_nobody_knows_along_the_axis() -> None:
    rows = _rows("ecmc_13e6c326")
    for each in (rows, _exchanged(rows)):
        found = _diagnosis(each)
        assert found.together[0].identifier == "thermal-drift"
        assert found.remainder is not None
        assert found.remainder.shape.en == "smooth along the axis"
