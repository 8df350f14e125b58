"""What is said of the errors of a machine and its work space is so, in the words of the page's language."""

import json
from pathlib import Path

import numpy as np
import pytest

from zlmreport.cli import main
from zlmreport.machines.kinematics import COMPONENTS, SQUARENESS

MACHINE = """\
schema: zlmreport/machine/1
chain: XYFZ
errors:
  - {EXX: {0: 0, 500: 2}, expanded_uncertainty: 0.6, at: {Y: -0.0000001}}
  - {EYY: {0: 0, 400: 2}, expanded_uncertainty: 0.6, source: granite square}
  - {EZZ: {0.25: 0, 500.75: 2}, expanded_uncertainty: 0.6}
"""
JOB = """\
schema: zlmreport/job/1
certificate: {number: ONE-RUN, kind: report}
axis: {name: X}
measurement: {at: {Y: 100, B: 30, tool: [0, 0, 120]}, source: {plugin: laser-csv, file: x.csv}}
evaluate: ["iso230-2:2014"]
"""


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Run a command of `machine` on a file, and return what it prints, on one line."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x.csv").write_text(
        "target,direction,run,deviation\n0,+,1,0\n200,+,1,3\n400,+,1,1\n", "utf-8"
    )
    (tmp_path / "x.yaml").write_text(JOB, encoding="utf-8")

    def run(text, *command):
        (tmp_path / "machine.yaml").write_text(text, encoding="utf-8")
        code = main(["machine", command[0], "machine.yaml", *command[1:]])
        found = capsys.readouterr()
        return code, " ".join((found.out + found.err).split())

    return run


def test_a_page_in_german_has_german_numbers_and_words(run, tmp_path):
    german = MACHINE + "certificate: {language: de}\n"
    assert run(german, "certificate", "--format", "html,json", "-o", "out")[0] == 0
    page = (tmp_path / "out" / "machine.html").read_text("utf-8")
    assert [place in page for place in ("Z = 0,25 mm", "Z = 0.25 mm")] == [True, False]
    assert [word in page for word in ("granite square", "angegeben", ">stated<")] == [True, True, False]
    values = json.loads((tmp_path / "out" / "machine.json").read_text("utf-8"))
    sources = {each["error"]: each.get("source") for each in values["prediction"]["errors"]}
    assert (sources["EXX"], sources["EYY"]) == ("stated", "granite square")


@pytest.mark.parametrize(("stated", "said"), [("-0.0000001", "0"), ("2543.188", "2543.188")])
def test_a_place_has_its_micrometres_and_no_minus_before_a_zero(run, stated, said):
    assert f"Y {said} " in run(MACHINE.replace("-0.0000001", stated), "check")[1]


def test_where_all_errors_are_known_nothing_is_said_of_errors_that_nobody_measured(run):
    lines = [f"  - {{{each}: {{0: 0, 500: 0}}, expanded_uncertainty: 0.6}}\n" for each in COMPONENTS]
    squares = [f"  - {{{each}: 1, expanded_uncertainty: 0.6}}\n" for each in SQUARENESS]
    said = run("schema: zlmreport/machine/1\nchain: XYFZ\nerrors:\n" + "".join(lines + squares), "predict")[1]
    assert "21 of 21 errors are known" in said
    assert "relative to the middle, is (" in said
    assert "nobody measured" not in said


def test_ranges_that_do_not_overlap_are_no_lack_of_measurements(run):
    apart = MACHINE + "  - {EYX: {600: 0, 700: 1, 800: 9}, expanded_uncertainty: 0.6}\n"
    said = "No work space: no place of X lies within the ranges of all errors that were measured of it."
    assert said in run(apart, "predict")[1]
    both = apart + "  - {EXY: {600: 0, 700: 1, 800: 9}, expanded_uncertainty: 0.6}\n"
    assert said.replace("of X", "of X or Y") in run(both, "predict")[1]
    none = "schema: zlmreport/machine/1\nchain: XYFZ\n"
    assert "the errors of no axis were measured over a range" in run(none, "predict")[1]


def test_a_single_run_has_no_uncertainty_of_nothing(run):
    code, said = run("schema: zlmreport/machine/1\nchain: XYFZ\nerrors: [x.yaml]\n", "predict")
    assert code == 0
    assert "0.000" not in said
    assert "No uncertainty is known of EXX: neither repeats nor an instrument tell it." in said
    assert "No uncertainty is known" not in run(MACHINE, "predict")[1]


def test_a_certificate_may_say_where_a_rotary_axis_stood(run):
    assert main(["x.yaml", "--format", "json", "-o", ".", "--quiet"]) == 0
    file = "schema: zlmreport/machine/1\nchain: XYFZ\nerrors: [{name}]\n"
    code, values = run(file.format(name="ONE-RUN.json").replace("{name}", ""), "predict", "--json")
    assert code == 0
    (known,) = (each for each in json.loads(values)["errors"] if each["known"])
    assert (known["at"], known["tool"]) == ({"Y": 100.0}, [0.0, 0.0, 120.0])


def test_an_error_that_is_stated_twice_is_named_by_what_it_is(run):
    twice = MACHINE + "  - {EXX: {0: 0, 300: 1}, expanded_uncertainty: 0.6}\n"
    code, said = run(twice, "predict")
    assert (code, said) == (2, "machine.yaml:7:5: EXX was named already, by a stated value; name it once")


def test_an_arc_in_which_no_axis_turns_says_nothing_of_play(folder, capsys):
    head, *rows = (folder / "circle-xy.csv").read_text("utf-8").splitlines()[1:]
    (folder / "circle-xy.csv").write_text("\n".join([head, *rows[:40]]), encoding="utf-8")
    assert main(["machine", "diagnose", str(folder / "machine.yaml"), "--json"]) == 0
    values = json.loads(capsys.readouterr().out)
    assert values["verdict"] == "adequate"
    assert 0 < values["p_value"] <= 1
    assert {"circle-backlash", "lateral-play"}.isdisjoint(each["effect"] for each in values["beside"])


@pytest.mark.parametrize(("tool", "meant"), [("", 120), ("tool: [0, 0, 0]", 0), ("tool: [0, 0, 80]", 80)])
def test_a_test_is_of_the_tool_that_it_states_also_of_none(run, tool, meant):
    """EYX of X leans with EAX by the tool's length above the point to which all errors refer."""
    file = (
        "schema: zlmreport/machine/1\nchain: XYFZ\ntool: [0, 0, 120]\nerrors:\n"
        "  - {EAX: {0: 0, 400: 20}, expanded_uncertainty: 0.1}\ntests: [line.yaml]\n"
    )
    line = JOB.replace("Y: 100, B: 30, tool: [0, 0, 120]", tool)
    Path("line.yaml").write_text(line.replace("{at:", "{error: EYX, at:").replace("-2:2014", "-1:2012"))
    code, values = run(file, "predict", "--json")
    assert code == 0
    (found,) = json.loads(values)["tests"]
    leaned = -np.radians(20 / 3600) * meant * 1e3
    assert found["predicted"][-1] - found["predicted"][0] == pytest.approx(leaned, abs=1e-9)


def test_errors_of_which_nobody_says_the_place_are_named_where_known_angles_show_in_them(run):
    """EBX makes ΔX of an arm along Z; of EYX it makes nothing, and where Z stood for EXX may be said."""
    angle = "  - {EBX: {0: 0, 500: 2}, expanded_uncertainty: 0.6}\n"
    said = "Of EXX nobody says where the other axes stood (at): arms of the known angles count from 0 there."
    straight = "  - {EYX: {0: 0, 200: 1, 500: 0}, expanded_uncertainty: 0.6}\n"
    assert said in run(MACHINE + straight + angle, "check")[1]
    assert "nobody says where" not in run(MACHINE + straight, "check")[1]
    assert "nobody says where" not in run(MACHINE.replace("at: {Y:", "at: {Z: 80, Y:") + angle, "check")[1]
