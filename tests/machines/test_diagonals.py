"""Diagonals of the work space as tests of a machine."""

import json

import numpy as np
import pytest

from zlmreport.cli import main

SIDES = np.array([400.0, 300.0, 200.0])
LENGTH = float(np.linalg.norm(SIDES))
ARCSECOND = np.radians(1 / 3600)
#: By which signs C0Y, B0Z and A0Z lengthen a diagonal, times their two sides over its length: by hand.
SIGNS = {"PPP": (-1, 1, -1), "NPP": (1, -1, -1), "PNP": (1, 1, 1), "NNP": (-1, -1, 1)}
FACES = {"XYPP": (0, 1, -1), "XYNP": (0, 1, 1), "XZPP": (0, 2, 1), "XZNP": (0, 2, -1), "YZPP": (1, 2, -1),
         "YZNP": (1, 2, 1)}  # fmt: skip
ERRORS = {"C0Y": 10.0, "B0Z": 6.0, "A0Z": -4.0}
AXES = "axes: {X: [100, 500], Y: [50, 350], Z: [0, 200]}"


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Predict a machine of which diagonals were measured; return exit code, and tests or what is said."""
    monkeypatch.chdir(tmp_path)

    def run(names, errors, **how):
        write(tmp_path, names, errors, **how)
        code = main(["machine", "predict", "machine.yaml", "--json"])
        found = capsys.readouterr()
        return code, {
            each["test"]: each for each in json.loads(found.out)["tests"]
        } if code == 0 else found.err

    return run


def write(tmp_path, names, errors, **how):
    """Write readings, job and machine. `how`: axes, at, the lines of the job; lengths, by name, mm."""
    axes, at = how.get("axes", AXES), how.get("at", "")
    for name in names:
        length = how.get("lengths", {}).get(name, LENGTH)
        rows = [
            f"{place},{way},1,0"
            for way, places in (("+", (0, length)), ("-", (length, 0)))
            for place in places
        ]
        (tmp_path / f"{name}.csv").write_text("\n".join(["target,direction,run,deviation", *rows]), "utf-8")
    tests = "\n".join(f"    {name}: {{source: {{plugin: laser-csv, file: {name}.csv}}}}" for name in names)
    (tmp_path / "diagonals.yaml").write_text(
        "schema: zlmreport/job/1\ncertificate: {number: D, kind: report}\n"
        f"{axes}\nmeasurement:\n{at}  tests:\n{tests}\nevaluate: [iso230-6:2002]\n",
        encoding="utf-8",
    )
    (tmp_path / "machine.yaml").write_text(
        f"schema: zlmreport/machine/1\nchain: XYFZ\ntool: [0, 0, 50]\nerrors:\n{errors}"
        "tests: [diagonals.yaml]\n",
        encoding="utf-8",
    )


SQUARE = "".join(f"  - {{{name}: {value}, expanded_uncertainty: 0.1}}\n" for name, value in ERRORS.items())


def test_squareness_lengthens_body_diagonals_by_its_sign_and_their_sides(run):
    code, found = run(SIGNS, SQUARE)
    assert code == 0
    for name, signs in SIGNS.items():
        pairs = ((0, 1), (0, 2), (1, 2))
        grown = sum(
            sign * value * ARCSECOND * SIDES[one] * SIDES[other] / LENGTH
            for sign, value, (one, other) in zip(signs, ERRORS.values(), pairs, strict=True)
        )
        predicted = found[f"diagonals-{name}"]["predicted"]
        assert predicted[1] - predicted[0] == pytest.approx(1e3 * grown, rel=1e-9)


def test_a_face_diagonal_shows_the_squareness_of_its_plane(run):
    lengths = {name: float(np.hypot(SIDES[one], SIDES[other])) for name, (one, other, _) in FACES.items()}
    code, found = run(FACES, SQUARE, lengths=lengths)
    assert code == 0
    names = {(0, 1): "C0Y", (0, 2): "B0Z", (1, 2): "A0Z"}
    for name, (one, other, sign) in FACES.items():
        grown = sign * ERRORS[names[one, other]] * ARCSECOND * SIDES[one] * SIDES[other] / lengths[name]
        predicted = found[f"diagonals-{name}"]["predicted"]
        assert predicted[1] - predicted[0] == pytest.approx(1e3 * grown, rel=1e-9)


def test_an_axis_loses_its_motion_by_its_own_way_and_not_by_that_of_the_diagonal(run, tmp_path):
    """On NNP X moves towards −X while the diagonal is run towards its end."""
    (tmp_path / "x.csv").write_text(
        "target,direction,run,deviation\n0,+,1,-2\n600,+,1,-2\n600,-,1,2\n0,-,1,2\n", "utf-8"
    )
    (tmp_path / "x.yaml").write_text(
        "schema: zlmreport/job/1\ncertificate: {number: X, kind: report}\naxis: {name: X}\n"
        'measurement: {source: {plugin: laser-csv, file: x.csv}}\nevaluate: ["iso230-2:2014"]\n',
        encoding="utf-8",
    )
    code, found = run(SIGNS, "  - x.yaml\n")
    assert code == 0
    for name in SIGNS:
        test = found[f"diagonals-{name}"]
        assert test["direction"] == [1, 1, -1, -1]
        # Lagging in X by 2 µm is lagging along the diagonal, whichever way it runs in X.
        lag = 2.0 * SIDES[0] / LENGTH
        assert test["predicted"] == pytest.approx([-lag, -lag, lag, lag], abs=1e-9)


def test_the_tool_of_diagonals_is_what_their_job_says(run):
    errors = "  - {EBX: {0: 0, 600: 12}, expanded_uncertainty: 0.1}\n"
    grown = []
    for at in ("", "  at: {tool: [0, 0, 0]}\n"):
        code, found = run(["PPP"], errors, at=at)
        assert code == 0
        values = found["diagonals-PPP"]["predicted"]
        grown.append(values[1] - values[0])
    turned = 12 * ARCSECOND * SIDES[0] / 600
    assert grown[0] - grown[1] == pytest.approx(1e3 * turned * 50 * SIDES[0] / LENGTH, rel=1e-6)


def test_diagonals_without_their_work_space_are_asked_for_it(run):
    code, said = run(["PPP"], SQUARE, axes="axes: {X: [0, 400]}")
    assert code == 2
    assert "diagonals.yaml:6:5: where PPP lies is not known: name from where to where Y moves" in said
