"""What a machine takes from a certificate of one of its axes."""

import json

import pytest

from zlmreport.errors import InputError, Place
from zlmreport.machines.axis_errors import make_curve_of_certificate

MEANS = [{"target": 0.0, "mean_fwd": 0.0}, {"target": 100.0, "mean_fwd": 2.0}]


def read(folder, positions):
    path = folder / "CAL-1.json"
    results = {
        "certificate": {"number": "CAL-1"},
        "measurements": {"axis": "X"},
        "evaluations": [{"positions": positions}],
    }
    path.write_text(json.dumps(results), encoding="utf-8")
    return make_curve_of_certificate(path, Place("machine.yaml"), lambda _path: None)


def test_the_means_of_a_certificate_are_a_curve(tmp_path):
    assert read(tmp_path, MEANS).values == pytest.approx([0.0, 2e-6])


def test_a_number_that_no_certificate_states_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"CAL-1\.json is no results file .*: NaN is no finite number"):
        read(tmp_path, [*MEANS, {"target": 200.0, "mean_fwd": float("nan")}])


def test_what_is_missing_is_named(tmp_path):
    with pytest.raises(InputError, match=r"evaluations.0.positions.0.target: Field required"):
        read(tmp_path, [{"mean_fwd": 0.0}])
