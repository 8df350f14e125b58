"""The command, the file and the notebook, on the project's own example."""

import json

import pytest

import zlmreport as z
from replacing import replace_in
from zlmreport.cli import main


def values(capsys, *arguments):
    assert main([*map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.long
def test_ten_minutes_tell_that_the_y_drive_lags(folder, capsys):
    path = folder / "machine.yaml"
    before = path.read_text(encoding="utf-8")
    found = values(capsys, "machine", "diagnose", path)
    assert found["schema"] == "zlmreport/diagnosis/1"
    assert (found["verdict"], found["set"]) == ("missing", ["servo-mismatch"])
    lag = found["candidates"][0]["parameters"][0]
    assert (lag["name"], lag["unit"]) == ("T_X-T_Y", "ms")
    assert lag["value"] == pytest.approx(-0.8, abs=2 * lag["expanded_uncertainty"])
    assert lag["expanded_uncertainty"] < 0.05
    assert any(text.startswith("Y lags behind X by 0.") for text in found["findings"])
    beside = {each["name"]: each for group in found["beside"] for each in group["parameters"]}
    for name in ("C0Y", "X-Y"):
        assert abs(beside[name]["value"]) < 1.5 * beside[name]["expanded_uncertainty"]
    (test,) = found["tests"]
    assert test["test"] == "circle-xy"
    assert test["rms_left"] > 4 * test["noise_rms"]

    changed = values(capsys, "machine", "add", path, "servo-mismatch")
    assert changed["after"]["error"]["rms"] < 0.1 * changed["before"]["error"]["rms"]
    assert "[centre-offset, radius, servo-mismatch] # where" in path.read_text(encoding="utf-8")
    assert values(capsys, "machine", "diagnose", path)["verdict"] == "adequate"
    taken = values(capsys, "machine", "remove", path, "servo-mismatch")
    assert taken == {**changed, "before": changed["after"], "after": changed["before"]}, "alike both ways"
    assert path.read_text(encoding="utf-8") == before


@pytest.mark.long
def test_build_writes_what_it_found(folder, capsys):
    path = folder / "machine.yaml"
    built = values(capsys, "machine", "build", path, "--dry-run")
    assert "servo-mismatch" not in path.read_text(encoding="utf-8")
    assert values(capsys, "machine", "build", path) == built
    assert "servo-mismatch" in path.read_text(encoding="utf-8")
    assert [each["effect"] for each in built["steps"]] == ["servo-mismatch"]
    assert built["verdict"] == "adequate"


@pytest.mark.long
def test_build_says_what_it_wrote_what_is_left_and_what_to_do_next(folder, capsys, monkeypatch):
    monkeypatch.chdir(folder)
    said = []
    for more in (["--dry-run"], [], []):
        assert main(["machine", "build", "machine.yaml", *more]) == 0
        said.append(capsys.readouterr().out)
    assert all("Missing" not in each and "nothing is left that the scatter" in each for each in said)
    assert [each.splitlines()[-2:] for each in said] == [
        [
            "machine.yaml: left as it is; without --dry-run: + servo-mismatch",
            "next: zlmreport machine build machine.yaml",
        ],
        ["machine.yaml: + servo-mismatch", "next: zlmreport machine certificate machine.yaml"],
        ["machine.yaml: nothing to change", "next: zlmreport machine certificate machine.yaml"],
    ]


def test_predict_states_bands_bounds_and_what_lies_outside(folder, capsys):
    found = values(capsys, "machine", "predict", folder / "machine.yaml")
    assert found["schema"] == "zlmreport/prediction/1"
    (test,) = found["tests"]
    assert test["test"] == "circle-xy"
    lists = [test[key] for key in ("at", "predicted", "expanded_uncertainty", "outside_measured_range")]
    assert {len(each) for each in lists} == {720}
    assert min(test["expanded_uncertainty"]) > 0.1
    assert not any(test["outside_measured_range"])
    assert len(found["errors"]) == 21
    assert all(each["bound"] > 0 for each in found["errors"] if not each["known"])
    assert found["volume"]["largest"] > 0
    assert len(found["diagonals"]) == 4


def test_what_lies_beyond_the_measured_range_is_marked(folder, capsys):
    path = folder / "circle-xy.yaml"
    replace_in(path, ("[250, 200", "[400, 200"))
    (test,) = values(capsys, "machine", "predict", folder / "machine.yaml")["tests"]
    beyond = [at for at, outside in zip(test["at"], test["outside_measured_range"], strict=True) if outside]
    assert beyond
    assert all(min(at % 360, -at % 360) < 49 for at in beyond)  # 400 + 150·cos θ > 500


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("chain: XYFZ", "chain: XYZ", "machine.yaml:7:8: chain: 'XYZ' is no chain"),
        (
            "xy-squareness.yaml",
            "{COY: 1, expanded_uncertainty: 1}",
            "machine.yaml:15:6: 'COY' is none of the 21 errors",
        ),
        ("xy-squareness.yaml", "{expanded_uncertainty: 1}", "machine.yaml:15:5: states no error; write for"),
        ("centre-offset,", "center-offset,", "did you mean 'centre-offset'?"),
        ("tests: [circle-xy.yaml]", "test: [circle-xy.yaml]", "did you mean 'tests'?"),
        ("  - y-positioning.yaml", "  - x-positioning.yaml", "EXX was named already"),
        ("[circle-xy.yaml]", "[circle-xz.yaml]", "circle-xz.yaml"),
        ("xy-squareness.yaml", "{EZX: 4, expanded_uncertainty: 1}", "values by the position of X"),
        ("xy-squareness.yaml", "circle-xy.yaml", "it is a circle, which two axes run; name it under tests"),
    ],
)
def test_a_mistake_is_told_with_its_place(folder, capsys, old, new, said):
    path = folder / "machine.yaml"
    replace_in(path, (old, new))
    assert main(["machine", "check", str(path)]) in {2, 3}
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("ccw,1,0.5,", "cccw,1,0.5,", "circle-xy.csv:3:1: 'cccw' is no sense of a circle"),
        ("sense,run,angle,deviation", "sense,run,angel,deviation", "circle-xy.csv:2"),
        ("ccw,1,0.5,", "ccw,1,nan,", "circle-xy.csv:3:7"),
    ],
)
def test_a_mistake_in_a_table_is_told_with_its_place(folder, capsys, old, new, said):
    path = folder / "circle-xy.csv"
    path.write_text(path.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
    assert main(["machine", "check", str(folder / "machine.yaml")]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.long
def test_a_certificate_is_read_back_with_its_uncertainty(folder, capsys):
    assert (
        main([str(folder / "x-positioning.yaml"), "--quiet", "--format", "pdf,json", "-o", str(folder)]) == 0
    )
    path = folder / "machine.yaml"
    text = path.read_text(encoding="utf-8")
    by_job = values(capsys, "machine", "predict", path)
    for suffix in ("json", "pdf"):
        path.write_text(text.replace("x-positioning.yaml", f"EXAMPLE-2026-0021.{suffix}"), encoding="utf-8")
        found = values(capsys, "machine", "predict", path)
        for key in ("predicted", "expanded_uncertainty"):
            assert found["tests"][0][key] == pytest.approx(by_job["tests"][0][key], rel=1e-9)


@pytest.mark.long
def test_the_notebook_says_the_same(folder):
    machine = z.machine(folder / "machine.yaml")
    assert repr(machine) == "<Machine XYFZ: 6 of 21 errors known, tests: 1, 4.7 µm left of its circles>"
    diagnosis = machine.diagnose()
    assert diagnosis.missing == ("servo-mismatch",)
    assert repr(diagnosis) == "<Diagnosis: Missing: Servo mismatch.>"
    assert "<li>No backlash of X" in diagnosis._repr_html_()
    assert machine.add("servo-mismatch").rms < 0.1 * machine.rms
    built = machine.build()
    assert built.machine.effects == ("centre-offset", "radius", "servo-mismatch")
    assert repr(built).startswith("<Build: + servo-mismatch 0.3")
    with pytest.raises(z.InputError, match="did you mean"):
        machine.add("servo-missmatch")


def test_in_a_notebook_axes_alone_predict_the_work_space(folder):
    path = folder / "machine.yaml"
    replace_in(path, ("tests: [circle-xy.yaml]", ""))
    machine = z.machine(path)
    assert repr(machine) == "<Machine XYFZ: 6 of 21 errors known, tests: 0>"
    assert machine.predict()["volume"]["largest"] == pytest.approx(5.07, abs=0.01)
    assert "the largest error, relative to the middle" in machine._repr_html_()
    with pytest.raises(z.InputError, match="no circle is among the tests"):
        machine.diagnose()


@pytest.mark.long
def test_where_the_bar_stands_belongs_into_every_model(folder, capsys):
    """A file without a model finds the same: neither centre nor length of the bar hides what is missing."""
    path = folder / "machine.yaml"
    stated = _diagnosis(path, capsys)
    text = path.read_text("utf-8")
    path.write_text(text[: text.index("model:")], "utf-8")
    found = _diagnosis(path, capsys)
    assert found["set"] == stated["set"] == ["servo-mismatch"]
    assert found["model"]["effects"] == ["centre-offset", "radius"]
    assert main(["machine", "add", str(path), "servo-mismatch"]) == 0
    assert main(["machine", "remove", str(path), "radius"]) == 2
    assert "radius belongs into every model" in capsys.readouterr().err


def test_a_notebook_adds_and_removes_as_the_command_does(folder):
    machine = z.machine(folder / "machine.yaml")
    better = machine.add(machine.diagnose().candidates[0])
    assert better.effects == (*machine.effects, "servo-mismatch")
    for change, said in (
        (lambda: better.add("servo-mismatch"), "servo-mismatch stands in the model already"),
        (lambda: machine.add("servo"), "'servo' is no effect; did you mean 'servo-"),
        (lambda: machine.add(None), "'None' is no effect"),
        (lambda: machine.remove("servo-mismatch"), "does not stand in the model; known: centre-offset"),
        (lambda: machine.remove("radius"), "radius belongs into every model: where a bar stands"),
        (lambda: machine.compensate("linuxcnc", step="far"), "step is 'far': rows are more than 0 mm apart"),
    ):
        with pytest.raises(z.InputError, match=said):
            change()
    assert repr(better.build()) == "<Build: nothing to add, adequate>"


def _diagnosis(path, capsys):
    assert main(["machine", "diagnose", str(path), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_files_that_are_not_there_are_told_with_all_other_mistakes(folder, capsys):
    path = folder / "machine.yaml"
    path.write_text(
        "schema: zlmreport/machine/1\nchain: XYZW\n"
        "errors: [gone.yaml, {COY: 1, expanded_uncertainty: 1}]\ntests: [lost.yaml]\n",
        "utf-8",
    )
    assert main(["machine", "check", str(path)]) == 2
    said = capsys.readouterr().err
    assert "machine.yaml:2:8: chain: 'XYZW'" in said
    assert "machine.yaml:3:10: " in said
    assert "gone.yaml: cannot be read" in said
    assert "'COY' is none of the 21 errors; with a zero it is C0Y" in said
    assert "machine.yaml:4:9: " in said
    assert "lost.yaml: cannot be read" in said


@pytest.mark.long
def test_what_lies_beyond_its_uncertainty_is_not_said_to_be_absent(folder, capsys):
    beside = _diagnosis(folder / "machine.yaml", capsys)["beside"]
    parameters = [each for effect in beside for each in effect["parameters"]]
    assert parameters
    assert all(abs(each["value"]) <= each["expanded_uncertainty"] for each in parameters)
