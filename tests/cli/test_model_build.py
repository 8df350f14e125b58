"""``zlmreport model build``: the whole loop in one command, and the job as it is then."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import zlmreport as z
from cli.commands import Shop, told
from cli.model_jobs import change, opened
from model.hidden_effect import LAST
from zlmreport.cli.terminal import lay_out_changes


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    return opened(tmp_path, monkeypatch, capsys)


def begin(shop: Shop) -> None:
    """Leave the model without the effect that the axis has besides."""
    change(shop, (LAST, f"{LAST}    # all the rest is to be found\n"))


@pytest.mark.long
def test_a_build_finds_all_that_the_axis_has(shop: Shop) -> None:
    begin(shop)
    built = told(shop.run("model", "build", "job.yaml", "--json"))
    assert built["schema"] == "zlmreport/build/1"
    assert {each["effect"] for each in built["steps"]} == {"screw-pitch"}
    assert built["steps"][0]["rms_before"] > 2 * built["steps"][-1]["rms_after"]
    for one, other in zip(built["steps"], built["steps"][1:], strict=False):
        assert other["rms_before"] == pytest.approx(one["rms_after"])
    assert built["steps"][-1]["rms_after"] == pytest.approx(built["steps"][-1]["noise_rms"], rel=0.15)
    assert (built["verdict"], built["remainder"]) == ("adequate", None)
    fitted = told(shop.run("model", "fit", "job.yaml", "--json"))
    assert fitted["error"]["rms"] == pytest.approx(built["steps"][-1]["rms_after"])


@pytest.mark.long
def test_the_job_has_the_effects_then_and_keeps_its_comments(shop: Shop) -> None:
    begin(shop)
    before = (shop.folder / "job.yaml").read_text(encoding="utf-8")
    shop.run("model", "build", "job.yaml")
    after = (shop.folder / "job.yaml").read_text(encoding="utf-8")
    assert set(before.splitlines()) <= set(after.splitlines())
    added = [each.strip() for each in after.splitlines() if each not in before.splitlines()]
    assert sorted(added) == ["- screw-pitch"]


def test_a_build_on_trial_writes_nothing(shop: Shop) -> None:
    begin(shop)
    before = (shop.folder / "job.yaml").read_bytes()
    run = shop.run("model", "build", "job.yaml", "--dry-run")
    assert run.code == 0
    assert "left as it is" in run.output
    line = " ".join(run.output.split())
    assert re.search(r"→ \+ screw-pitch [\d.]+ µm; noise [\d.]+ µm ", line)
    assert (shop.folder / "job.yaml").read_bytes() == before


@pytest.mark.parametrize("trial", [(), ("--dry-run",)])
def test_a_build_tells_that_a_job_has_its_effects_from_another_no_longer(
    shop: Shop, trial: tuple[str, ...]
) -> None:
    (shop.folder / "own.yaml").write_text("extends: job.yaml\n", encoding="utf-8")
    run = shop.run("model", "build", "own.yaml", *trial)
    told_of_origin = "own.yaml had its effects from job.yaml; now they stand in own.yaml itself\n"
    assert (told_of_origin in run.output) == (not trial)


def test_no_line_of_a_build_is_wider_than_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    names = ["+ backlash", "− compensation-shift", "+ scale-expansion or material-expansion"]
    lines = list(lay_out_changes("a-folder/with-a-long-name/job.yaml", names, is_tried=True))
    assert max(map(len, lines)) <= 80
    assert not any(line.endswith(("+", "−")) for line in lines)
    assert " ".join(line.strip() for line in lines).endswith(", ".join(names))


def test_a_model_that_lacks_nothing_is_left_as_it_is(shop: Shop) -> None:
    shop.run("model", "add", "job.yaml", "screw-pitch")
    before = (shop.folder / "job.yaml").read_bytes()
    built = told(shop.run("model", "build", "job.yaml", "--json"))
    assert (built["steps"], built["verdict"]) == ([], "adequate")
    assert (shop.folder / "job.yaml").read_bytes() == before


def test_only_a_build_is_made_on_trial(shop: Shop) -> None:
    run = shop.run("model", "fit", "job.yaml", "--dry-run")
    assert run.code == 2
    assert "--dry-run belongs to build, not to fit" in run.messages


def test_a_notebook_builds_as_the_command_does(shop: Shop) -> None:
    axis = {"name": "X", "kind": "linear", "travel": [0, 600], "screw_pitch": 10}
    model = z.fit(z.read(shop.folder / "x-axis.csv", axis=axis), ["offset", "scale-error", "backlash"])
    built = model.build()
    assert {each.effect for each in built.steps} == {"screw-pitch"}
    assert built.verdict == "adequate"
    assert built.model.rms == pytest.approx(built.steps[-1].rms_after)
    assert model.effects == ("offset", "scale-error", "backlash")
