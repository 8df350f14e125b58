"""What a machine takes from a certificate of one of its axes."""

import json

import pytest

from zlmreport.machines.reading import read_machine
from zlmreport.plugin import InputError
from zlmreport.plugin.registry import find_plugins

MEANS = [{"target": 0.0, "mean_fwd": 0.0}, {"target": 100.0, "mean_fwd": 2.0}]


def read(folder, positions):
    results = {
        "certificate": {"number": "CAL-1"},
        "measurements": {"axis": "X"},
        "evaluations": [{"positions": positions}],
    }
    (folder / "CAL-1.json").write_text(json.dumps(results), encoding="utf-8")
    path = folder / "machine.yaml"
    path.write_text("schema: zlmreport/machine/1\nchain: XYFZ\nerrors: [CAL-1.json]\n", encoding="utf-8")
    return read_machine(path, find_plugins()).machine.curves


def test_the_means_of_a_certificate_are_a_curve(tmp_path):
    (curve,) = read(tmp_path, MEANS)
    assert curve.values == pytest.approx([0.0, 2e-6])


def test_a_number_that_no_certificate_states_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"CAL-1\.json is no results file .*: NaN is no finite number"):
        read(tmp_path, [*MEANS, {"target": 200.0, "mean_fwd": float("nan")}])


def test_what_is_missing_is_named(tmp_path):
    with pytest.raises(InputError, match=r"evaluations.0.positions.0.target: Field required"):
        read(tmp_path, [{"mean_fwd": 0.0}])
