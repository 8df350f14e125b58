"""How a machine begins, and what it takes from a certificate of one of its axes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from environments import ROOT
from zlmreport.cli import main
from zlmreport.job.loading import load
from zlmreport.machines.axis_errors import make_curve_of_certificate
from zlmreport.machines.reading import read_machine
from zlmreport.plugin import InputError, Place
from zlmreport.plugin.registry import find_plugins

READINGS = ROOT / "configs" / "machine"
#: What a service engineer calls the files of the example.
NAMES = {
    "x-positioning.csv": "X position.csv",
    "y-positioning.csv": "y_lin.csv",
    "z-positioning.csv": "Z.csv",
    "x-straightness.csv": "x-straightness.csv",
    "y-straightness.csv": "Y Geradheit horizontal.csv",
}


@pytest.fixture(autouse=True)
def readings(tmp_path: Path) -> Path:
    """Return the files of a machine as they come from the workshop: axes, a ballbar's run in each sense."""
    folder = tmp_path / "readings"
    folder.mkdir()
    for name, called in NAMES.items():
        (folder / called).write_bytes((READINGS / name).read_bytes())
    head, *rows = (READINGS / "circle-xy.csv").read_text("utf-8").splitlines()[1:]
    for name, sense in (("ballbar-XY-R150-F1000-ccw.csv", "ccw"), ("ballbar-cw.csv", "cw")):
        (folder / name).write_text("\n".join([head, *(each for each in rows if each.startswith(sense))]))
    return folder


def fill_in(name: str, *values: tuple[str, str]) -> None:
    path = Path("mill", name)
    text = path.read_text("utf-8")
    for commented, stated in values:
        assert commented in text
        text = text.replace(commented, stated)
    path.write_text(text, "utf-8")


def ask(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    assert main(["machine", *arguments, "--json"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize(
    "names",
    [
        {
            "EYX": "EYX",
            "X-Achse_Positionierung": "EXX",
            "y-straightness-z": "EZY",
            "z straightness in x": "EXZ",
            "x_pitch": "EBX",
            "Y yaw": "ECY",
            "z-roll": "ECZ",
            "y1 nicken": "EAY",
        },
        {
            "y-straightness": "not known: across which axis it is: EXY or EZY",
            "z-pitch": "not known: about which axis it tilts: EAZ or EBZ",
            "measurement-17": "not known: which axis moved, and which error was measured",
            "c0y-square": "not known: which line of C0Y it is: EYX or EXY",
        },
    ],
    ids=["told", "left open"],
)
def test_the_name_of_a_file_says_which_error_it_holds_or_what_is_asked(
    readings: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], names: dict[str, str]
) -> None:
    (own := tmp_path / "own").mkdir()
    for name in names:
        (own / f"{name}.csv").write_bytes((readings / "Z.csv").read_bytes())
    assert main(["init", str(tmp_path / "mill"), "--machine", str(own)]) == 0
    said = capsys.readouterr().out
    assert [name for name, error in names.items() if f"{name}.csv: {error}\n" not in said] == []


def test_the_name_of_a_circle_says_plane_radius_and_feed(readings: Path, tmp_path: Path) -> None:
    named = (readings / "ballbar-cw.csv").rename(readings / "ballbar xz R100mm F3000.csv")
    assert main(["init", str(tmp_path / "mill"), "--machine", str(named)]) == 0
    job = (tmp_path / "mill" / "ballbar-xz-R100mm-F3000.yaml").read_text("utf-8")
    for stated in ("plane: ZX", "radius: 100", "feed: 3000"):
        assert f"\n  {stated}" in job


@pytest.mark.long
def test_six_axes_and_two_runs_of_a_ballbar_tell_that_the_y_drive_lags(
    readings: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """From files to a machine that is square, of equal scales, its lag known: a new user's ten minutes."""
    monkeypatch.chdir(tmp_path)
    (readings / "x-straightness.csv").rename(readings / "EYX.csv")
    (readings / "EZX.csv").write_bytes((readings / "EYX.csv").read_bytes())  # no part of a circle in XY
    assert main(["init", "mill", "--machine", "readings"]) == 0
    assert "not known" not in capsys.readouterr().out
    fill_in("ballbar-cw.yaml", ("# radius: 150", "radius: 150"), ("# feed: 1000", "feed: 1000"))
    for name in ("ballbar-cw.yaml", "ballbar-XY-R150-F1000-ccw.yaml"):
        fill_in(name, ("# centre: [0, 0, 0]", "centre: [250, 200, 0]"))
    path = "mill/machine.yaml"
    found = ask(capsys, "diagnose", path)
    assert (found["verdict"], found["set"]) == ("missing", ["servo-mismatch"])
    assert any(each.startswith("Y lags behind X by 0.79") for each in found["findings"])
    values = {each["name"]: each for each in found["candidates"][0]["parameters"]}
    assert values["T_X-T_Y"]["value"] == pytest.approx(-0.8, abs=values["T_X-T_Y"]["expanded_uncertainty"])
    beside = {each["effect"]: each for each in found["beside"]}
    assert "X and Y are square" in beside["squareness"]["statements"][0]
    assert "The scales of X and Y agree" in f"T{beside['scale-mismatch']['statements'][0][1:]}"
    # The file of the machine has it now, and each of both runs differs by no more than its readings scatter.
    changed = ask(capsys, "add", path, "servo-mismatch")
    assert "servo-mismatch" in Path(path).read_text("utf-8")
    for before, after in zip(changed["before"]["tests"], changed["after"]["tests"], strict=True):
        assert before["rms_left"] > 4.5
        assert after["rms_left"] == pytest.approx(after["noise_rms"], rel=0.15)
    again = ask(capsys, "diagnose", path)
    assert (again["verdict"], again["set"]) == ("adequate", [])


def test_a_machine_begins_with_files_and_says_what_only_its_user_knows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["init", "mill", "--machine", "readings"]) == 0
    said = capsys.readouterr().out
    assert "y_lin.csv: EYY\n" in said
    assert "x-straightness.csv: not known: across which axis it is: EYX or EZX\n" in said
    assert "mill/ballbar-cw.yaml:7: nominal radius, mm\n" in said
    assert "ballbar-XY-R150-F1000-ccw.yaml:9: centre of the circle" in said
    assert said.endswith("next: zlmreport machine check mill/machine.yaml\n")
    # As it is, what is missing is told with its place.
    assert main(["machine", "check", "mill/machine.yaml"]) == 2
    assert "mill/ballbar-cw.yaml:5:1: circle: missing" in capsys.readouterr().err

    fill_in("x-straightness.yaml", ("# error: EYX", "error: EYX"))
    fill_in("machine.yaml", ("# - x-straightness.yaml", "- x-straightness.yaml"))
    fill_in("ballbar-cw.yaml", ("# radius: 150", "radius: 150"), ("# feed: 1000", "feed: 1000"))
    machine = read_machine(Path("mill/machine.yaml"), find_plugins())
    assert {each.name for each in machine.machine.curves} == {"EXX", "EYY", "EZZ", "EYX", "EXY"}
    assert [each.nominal.feed * 60e3 for each in machine.circles] == pytest.approx([1000, 1000])


def test_one_job_makes_one_document_of_all_that_was_measured(
    readings: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("ppp", "npp", "pnp", "nnp"):
        content = (ROOT / "configs" / "whole-machine" / f"{name}.csv").read_bytes()
        (readings / f"diagonal {name}.csv").write_bytes(content)
    for name in ("x-straightness.csv", "ballbar-cw.csv"):  # of these something would have to be said
        (readings / name).unlink()
    assert main(["init", str(tmp_path / "mill"), "--machine", str(readings)]) == 0
    assert "diagonals of the work space: NNP, NPP, PNP, PPP\n" in capsys.readouterr().out
    job = load(tmp_path / "mill" / "document.yaml", find_plugins())
    assert {*job.measurements} == {"EXX", "EYY", "EZZ", "EXY", "ballbar-XY-R150-F1000-ccw", "diagonals"}
    assert job.measurements["diagonals"].axis.measurand.identifier == "diagonals"
    content = (tmp_path / "mill" / "machine.yaml").read_text("utf-8")
    assert content.endswith("tests:\n  - ballbar-XY-R150-F1000-ccw.yaml\n  - diagonals.yaml\n")


def test_jobs_that_are_begun_are_sound_whatever_their_files_are_called(
    readings: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in readings.iterdir():
        if path.name not in [NAMES[f"{axis}-positioning.csv"] for axis in "xyz"]:
            path.unlink()
    names = ["_Gerät X Ä.csv", "测量 y.csv", f"z{'z' * 150} Z.csv", "squareness-C0Y.csv"]
    for path, name in zip(sorted(readings.iterdir()), names, strict=False):
        path.rename(readings / name)
    (readings / names[3]).write_bytes((readings / names[0]).read_bytes())
    mill = tmp_path / "mill"
    assert main(["init", str(mill), "--machine", str(readings)]) == 0
    assert "squareness-C0Y.csv: not known: which line of C0Y it is: EYX or EXY" in capsys.readouterr().out
    jobs = [path for path in mill.glob("*.yaml") if path.stem not in {"machine", "shared", "document"}]
    assert {"Gerat-X-A", "y"} < {path.stem for path in jobs}
    assert len(jobs) == len(names)
    for path in (
        each for each in jobs if not each.stem.startswith("squareness")
    ):  # that one is to be filled in
        assert load(path, find_plugins()).keys.certificate.number == path.stem


def test_nothing_is_written_over_and_a_file_of_no_table_is_told(
    readings: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "mill").mkdir()
    (tmp_path / "mill" / "machine.yaml").write_text("mine")
    only = readings / "Z.csv"
    assert main(["init", str(tmp_path / "mill"), "--machine", str(only)]) == 2
    assert "is there already" in capsys.readouterr().err
    assert [each.name for each in (tmp_path / "mill").iterdir()] == ["machine.yaml"]
    only.write_text("Dear reader,\n")
    assert main(["init", str(tmp_path / "new"), "--machine", str(only)]) == 2
    assert "Z.csv" in capsys.readouterr().err
    assert main(["init", str(tmp_path / "new"), "--machine", str(tmp_path / "none.csv")]) == 3


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
def test_a_document_on_something_else_is_called_what_it_is(
    tmp_path: Path, document: dict[str, Any], said: str
) -> None:
    path = tmp_path / "CAL-7.json"
    path.write_text(json.dumps({"certificate": {"number": "CAL-7"}, **document}), encoding="utf-8")
    with pytest.raises(InputError, match=rf"CAL-7\.json .*{said}"):
        make_curve_of_certificate(path, Place("machine.yaml", 3, 9), lambda _: None)


def test_a_rotary_axis_gets_a_job_of_its_own_and_the_axis_behind_of_is_the_one_that_moves(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = tmp_path / "by hand"
    files.mkdir()
    for name, last in (("C position.csv", 360), ("x straightness of y.csv", 400)):
        rows = [f"{target},{way},{run},{target % 7}" for run in (1, 2) for way in "+-"
                for target in range(0, last + 1, last // 8)[:: 1 if way == "+" else -1]]  # fmt: skip
        (files / name).write_text("\n".join(["target,direction,run,deviation", *rows]), "utf-8")
    assert main(["init", str(tmp_path / "mill"), "--machine", str(files)]) == 0
    said = capsys.readouterr().out
    assert "C position.csv: positions of the rotary axis C, none of the 21 errors\n" in said
    assert "x straightness of y.csv: EXY\n" in said
    job = load(tmp_path / "mill" / "C-position.yaml", find_plugins())
    assert (job.axis.name, job.axis.kind.value) == ("C", "rotary")
    content = (tmp_path / "mill" / "machine.yaml").read_text("utf-8")
    assert "x-straightness-of-y.yaml # EXY" in content
    assert "C-position" not in content
    assert "- C-position.yaml" in (tmp_path / "mill" / "document.yaml").read_text("utf-8")
