"""What the page on real measurements says of all sets together, whichever way the directions are labelled."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import INSTALLED, model_of
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.diagnosis import Diagnosis, Verdict, diagnose
from zlmreport.model.observations import observations_of
from zlmreport.quantities.units import MICROMETRE, MILLIMETRE

_DATA = Path(__file__).parents[1] / "data" / "published"
VERDICTS = {
    "ecmc_13e6c326": Verdict.MISSING,
    "ecmc_0657b0d4": Verdict.UNEXPLAINED,
    "ecmc_1139bca6": Verdict.UNEXPLAINED,
    "ecmc_2845f959": Verdict.MISSING,
    "ecmc_59b90437": Verdict.UNEXPLAINED,
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


def _diagnosis(rows: list[tuple[float, int, int, float]]) -> Diagnosis:
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
    return diagnose(model_of("offset", "scale-error", "backlash"), observations_of(measurements), INSTALLED)


@pytest.mark.parametrize("name", VERDICTS)
def test_only_the_verdict_of_ild50_rests_on_the_labels_of_the_directions(name: str) -> None:
    rows = _rows(name)
    exchanged = Verdict.UNEXPLAINED if name == "ecmc_2845f959" else VERDICTS[name]
    assert [_diagnosis(each).verdict for each in (rows, _exchanged(rows))] == [VERDICTS[name], exchanged]


def test_readings_that_stand_off_become_the_first_two_of_the_test() -> None:
    found = _diagnosis(_exchanged(_rows("ecmc_1139bca6")))
    assert found.outliers.tolist() == [0, 1]


def test_which_of_the_equals_leads_rests_on_the_labels() -> None:
    rows = _rows("ecmc_2845f959")
    leaders = [_diagnosis(each).candidates[0].identifier for each in (rows, _exchanged(rows))]
    assert leaders == ["thermal-growth", "time-periodic"]
