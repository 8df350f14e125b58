"""``zlmreport model``: see where the model fails, learn what is missing, add it and watch the error fall."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

import pytest

from cli.commands import Shop, told
from cli.model_jobs import change, keep, opened
from model.hidden_effect import LAST, example_diagnosis
from zlmreport.cli import main
from zlmreport.model.diagnosis.study import Study

GOLDEN = Path(__file__).with_name("golden")
#: Numbers are held by the tests of the engine, and by the pages that show them.
_NUMBER = re.compile(r"[−-]?\d[\d.]*(e-\d+)?")
_BAR = re.compile(r"[█▏▎▍▌▋▊▉]+")
_GAP = re.compile(r"(?<=\S) {2,}")
EFFECTS = ["offset", "scale-error", "backlash"]


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    return opened(tmp_path, monkeypatch, capsys)


def effects(shop: Shop) -> list[str]:
    """Return the lines of the job's list of effects."""
    text = (shop.folder / "job.yaml").read_text(encoding="utf-8")
    return [line.strip() for line in text.partition("effects:\n")[2].partition("output:")[0].splitlines()]


@pytest.fixture
def diagnosed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let commands take the diagnosis of the example from the shelf: what they make of it counts here."""
    diagnosis = example_diagnosis()
    monkeypatch.setattr(Study, "diagnose", lambda *_: diagnosis)


@pytest.mark.usefixtures("diagnosed")
@pytest.mark.parametrize(
    "arguments",
    [["fit"], ["diagnose"], ["history"], ["add", "screw-pitch"], ["remove", "backlash"]],
    ids=lambda arguments: arguments[0],
)
def test_what_people_read_is_what_was_approved(shop: Shop, arguments: list[str]) -> None:
    """Set ZLMREPORT_APPROVE=1 to take the present text as approved, and read the difference."""
    action, *effect = arguments
    run = shop.run("model", action, "job.yaml", *effect)
    assert (run.code, run.messages) == (0, "")
    text = _GAP.sub("  ", _BAR.sub("█", _NUMBER.sub("#", run.output)))
    approved = GOLDEN / f"model-{action}.txt"
    if os.environ.get("ZLMREPORT_APPROVE"):
        approved.parent.mkdir(exist_ok=True)
        approved.write_text(text, encoding="utf-8")
    assert text == approved.read_text(encoding="utf-8")


def test_the_loop_from_a_model_that_does_not_fit_to_one_that_does(shop: Shop) -> None:
    before = told(shop.run("model", "diagnose", "job.yaml", "--json"))
    assert before["verdict"] == "missing"
    assert before["candidates"][0]["effect"] == "screw-pitch"
    assert shop.run("model", "add", "job.yaml", before["candidates"][0]["effect"]).code == 0
    after = told(shop.run("model", "diagnose", "job.yaml", "--json"))
    assert after["verdict"] == "adequate"
    assert after["candidates"] == []
    assert after["error"]["rms"] == pytest.approx(before["candidates"][0]["rms_after"], rel=0.01)
    assert after["error"]["rms"] < 1.2 * after["error"]["noise_rms"]


@pytest.mark.usefixtures("diagnosed")
def test_a_diagnosis_has_the_keys_of_its_schema(shop: Shop) -> None:
    diagnosis = told(shop.run("model", "diagnose", "job.yaml", "--json"))
    assert diagnosis["schema"] == "zlmreport/diagnosis/1"
    assert diagnosis["model"]["effects"] == EFFECTS
    (lost_motion,) = [each for each in diagnosis["model"]["parameters"] if each["effect"] == "backlash"]
    assert (lost_motion["name"], lost_motion["unit"]) == ("lost_motion", "um")
    assert lost_motion["value"] == pytest.approx(-4.0, abs=lost_motion["expanded_uncertainty"])
    assert diagnosis["error"].keys() >= {"rms", "noise_rms", "chi2_per_dof", "cross_validated_rms", "unit"}
    assert diagnosis["failures"][0].keys() == {"test", "p_value", "where", "statement"}
    assert diagnosis["candidates"][0].keys() >= {
        "effect",
        "p_value",
        "probability",
        "rms_after",
        "cross_validated_rms_after",
        "parameters",
        "explains",
        "indistinguishable_from",
        "discriminate_by",
    }


def test_a_job_without_a_model_is_diagnosed(shop: Shop) -> None:
    change(shop, (f"model:\n  effects:\n    - offset\n    - scale-error\n{LAST}", ""))
    keep(shop, readings=2 * 21)
    assert told(shop.run("model", "diagnose", "job.yaml", "--json"))["model"]["effects"] == []


def test_a_test_of_one_target_is_diagnosed_and_a_longer_one_advised(shop: Shop) -> None:
    rows = [
        f"100,{sign},{run},{3 + 2 * int(sign + '1') + 0.3 * ((7 * run) % 5 - 2)}\n"
        for run in range(1, 11)
        for sign in "+-"
    ]
    (shop.folder / "one.csv").write_text("target,direction,run,deviation\n" + "".join(rows), encoding="utf-8")
    (shop.folder / "one.yaml").write_text(
        "schema: zlmreport/job/1\ncertificate: {number: ONE, kind: report}\n"
        "axis: {name: X, travel: [0, 500]}\n"
        "measurement: {date: 2026-01-01, source: {plugin: laser-csv, file: one.csv}}\n"
        "evaluate: [iso230-2:2014]\nmodel: {effects: [offset]}\noutput: {directory: out}\n",
        encoding="utf-8",
    )
    lines = " ".join(shop.run("model", "diagnose", "one.yaml").output.split())
    assert "Missing effect: backlash or backlash-gradient" in lines
    assert "To tell backlash and backlash-gradient apart: take 21 targets" in lines


def test_a_model_can_be_begun(shop: Shop) -> None:
    change(shop, (f"model:\n  effects:\n    - offset\n    - scale-error\n{LAST}", ""))
    run = shop.run("model", "add", "job.yaml", "scale-error")
    assert (run.code, run.messages) == (0, "")
    assert (
        (shop.folder / "job.yaml")
        .read_text(encoding="utf-8")
        .endswith("model:\n  effects:\n    - scale-error\n")
    )


def test_adding_tells_the_error_before_and_after(shop: Shop) -> None:
    told_ = told(shop.run("model", "add", "job.yaml", "screw-pitch", "--json"))
    assert (told_["added"], told_["removed"]) == ("screw-pitch", [])
    assert told_["error"]["rms"] < 0.4 * told_["error_before"]["rms"]
    assert [step["effect"] for step in told_["steps"]] == [None, *EFFECTS, "screw-pitch"]
    assert effects(shop) == ["- offset", "- scale-error", "- backlash", "- screw-pitch"]


def test_adding_what_contains_others_takes_their_place(shop: Shop) -> None:
    told_ = told(shop.run("model", "add", "job.yaml", "polynomial: {order: 5}", "--json"))
    assert (told_["added"], told_["removed"]) == ("polynomial", ["offset", "scale-error"])
    assert effects(shop) == ["- backlash", "- polynomial: {order: 5}"]


def test_adding_another_form_of_an_effect_takes_its_place(shop: Shop) -> None:
    change(shop, (LAST, f"{LAST}    - screw-pitch: {{harmonics: [1]}}\n"))
    shop.run("model", "add", "job.yaml", "screw-pitch")
    assert effects(shop)[-2:] == ["- backlash", "- screw-pitch"]


def test_adding_and_removing_leaves_the_job_as_it_was(shop: Shop) -> None:
    before = (shop.folder / "job.yaml").read_bytes()
    shop.run("model", "add", "job.yaml", "screw-pitch")
    assert (shop.folder / "job.yaml").read_bytes() != before
    shop.run("model", "remove", "job.yaml", "screw-pitch")
    assert (shop.folder / "job.yaml").read_bytes() == before


def test_effects_that_were_inherited_are_said_to_stand_in_the_job_now(shop: Shop) -> None:
    shop.write("own.yaml", "extends: job.yaml\ncertificate: {number: OWN}\n")
    run = shop.run("model", "add", "own.yaml", "screw-pitch")
    assert run.output.startswith(
        "own.yaml had its effects from job.yaml; now they stand in own.yaml itself\n"
    )


@pytest.mark.parametrize("effect", ["first-run", "scale-kink"], ids=["linear alone", "with a searched place"])
def test_an_effect_that_does_not_stand_out_is_told(shop: Shop, effect: str) -> None:
    run = shop.run("model", "add", "job.yaml", effect)
    assert run.code == 0
    assert "it may not be there" in run.output


def test_a_history_of_a_straightness_forecasts_no_control(shop: Shop) -> None:
    rows = [
        f"{at},{way},{run},{0.01 * at + run}" for run in (1, 2) for way in "+-" for at in (0, 50, 100, 150)
    ]
    shop.write("straight.csv", "\n".join(["target,direction,run,deviation", *rows]) + "\n")
    shop.write(
        "straight.yaml",
        "schema: zlmreport/job/1\ncertificate: {number: S-1, kind: report}\naxis: {name: Y}\n"
        "measurement: {error: EXY, source: {plugin: laser-csv, file: straight.csv}}\n"
        'evaluate: ["iso230-1:2012"]\nmodel: {effects: [offset]}\n',
    )
    run = shop.run("model", "history", "straight.yaml")
    assert run.code == 0, run.messages
    assert "+ offset" in run.output
    assert "if the control corrects" not in run.output
    assert told(shop.run("model", "history", "straight.yaml", "--json"))["steps"][1]["predicted"] == []


def test_a_history_tells_every_step_with_what_standards_would_say(shop: Shop) -> None:
    steps = told(shop.run("model", "history", "job.yaml", "--json"))["steps"]
    errors = [step["error"]["rms"] for step in steps]
    assert errors == sorted(errors, reverse=True)
    assert [each["symbol"] for each in steps[0]["predicted"][0]["parameters"]] == ["A", "E", "R"]
    assert steps[-1]["predicted"][0]["parameters"][1]["value"] < 6


def test_a_fit_tells_its_parameters(shop: Shop) -> None:
    fit = told(shop.run("model", "fit", "job.yaml", "--json"))
    assert fit["schema"] == "zlmreport/fit/1"
    assert [each["name"] for each in fit["model"]["parameters"]] == ["offset", "slope", "lost_motion"]


@pytest.mark.usefixtures("diagnosed")
def test_the_main_job_says_that_its_model_lacks_something(shop: Shop) -> None:
    run = shop.run("job.yaml", "--output", "out", "--format", "json")
    assert "model    Missing effect: screw-pitch, which explains the rest.\n" in run.output
    assert "see: zlmreport model diagnose job.yaml\n" in run.output


def test_the_main_job_shows_the_share_that_is_done(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(sys.stderr), "isatty", lambda _: True, raising=False)
    keep(shop, readings=2 * 21)
    shares = re.findall(r"diagnosing +(\d+)%", shop.run("job.yaml", "--format", "json").messages)
    assert len(set(shares)) > 2
    assert list(map(int, shares)) == sorted(map(int, shares))
    assert not shop.run("job.yaml", "--format", "json", "--quiet").messages


def test_a_check_says_that_an_adequate_model_is_one(shop: Shop) -> None:
    change(shop, (LAST, f"{LAST}    - screw-pitch\n"))
    run = shop.run("check", "job.yaml")
    assert "model    The model describes the readings" in run.output
    assert "see: zlmreport model" not in run.output


def test_help_tells_every_action(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["model", "--help"]) == 0
    text = capsys.readouterr().out
    assert all(f"  {action} " in text for action in ("fit", "diagnose", "add", "remove", "history"))


_FORMULA = """  candidates:
    - name: my-wave
      formula: "a*sin(2*pi*P/L) + b*cos(2*pi*P/L)"
      parameters: {a: {unit: um}, b: {unit: um}, L: {unit: mm, range: [5, 50]}}
"""


@pytest.mark.long
def test_formula_is_tried_added_checked_and_certified(shop: Shop) -> None:
    change(shop, (LAST, f"{LAST}{_FORMULA}"))
    found = told(shop.run("model", "diagnose", "job.yaml", "--json"))
    assert "my-wave" in [each["effect"] for each in (*found["candidates"], *found["not_testable"])]
    assert shop.run("model", "add", "job.yaml", "my-wave").code == 0
    model = told(shop.run("model", "fit", "job.yaml", "--json"))["model"]
    assert [each["name"] for each in model["parameters"] if each["effect"] == "my-wave"] == ["a", "b", "L"]
    assert shop.run("check", "job.yaml").code == 0
    assert shop.run("job.yaml").code == 0
