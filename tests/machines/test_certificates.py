"""What a machine takes from a certificate of one of its axes."""

import json

import pytest

from zlmreport.errors import Place
from zlmreport.machines.axis_errors import make_curve_of_certificate
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


@pytest.mark.parametrize(
    ("document", "said"),
    [
        (
            {"schema": "zlmreport/machine-results/1"},
            "is on a whole machine; name the jobs or certificates of its",
        ),
        ({"parts": []}, "holds several measurements; name the job or the certificate of each"),
        ({"measurements": {"axis": "XY"}}, "is on a circle in XY, .* name its job under tests"),
        ({"measurements": {"axis": "PPP NPP PNP NNP"}}, r"several lines or channels \(PPP NPP PNP NNP\)"),
    ],
)
def test_a_document_on_something_else_is_called_what_it_is(tmp_path, document, said):
    path = tmp_path / "CAL-7.json"
    path.write_text(json.dumps({"certificate": {"number": "CAL-7"}, **document}), encoding="utf-8")
    with pytest.raises(InputError, match=rf"CAL-7\.json .*{said}"):
        make_curve_of_certificate(path, Place("machine.yaml", 3, 9), lambda _: None)
