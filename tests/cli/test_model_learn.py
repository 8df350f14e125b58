"""Learning from earlier tests, and using it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from cli.commands import Shop
from environments import ROOT

_CONFIG = ROOT / "configs" / "second-test"
_PRIORS = """schema: zlmreport/priors/1
kind: linear
tests: 8
noise: {position: {ratios: [0, 0.1], probabilities: [1, 3]}}
effects: {scale-expansion: {rms: 2, tests: 8}}
"""


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    """A folder of tests whose models describe their readings but for one, and a job beside it."""
    monkeypatch.chdir(tmp_path)
    for name in ("cool", "warm"):
        shutil.copy(_CONFIG / f"{name}.csv", tmp_path)
    shop = Shop(tmp_path, capsys)
    lacking = (_CONFIG / "cool.yaml").read_text(encoding="utf-8")
    whole = lacking.replace("    - backlash\n", "    - backlash\n    - scale-expansion\n")
    shop.write("earlier/cool.yaml", whole.replace("file: cool", "file: ../cool"))
    shop.write("earlier/deep/warm.yaml", whole.replace("file: cool", "file: ../../warm"))
    shop.write("earlier/again.yaml", whole.replace("file: cool", "file: ../cool"))
    shop.write("earlier/a-lacking.yaml", lacking.replace("file: cool", "file: ../warm"))
    shop.write(
        "earlier/bare.yaml", lacking[: lacking.index("\nmodel:") + 1].replace("file: cool", "file: ../warm")
    )
    shop.write("earlier/laboratory.yaml", "laboratory: {name: Sample}\n")
    shop.write("job.yaml", lacking.replace("\nmodel:", "\nmodel:\n  priors: priors.yaml"))
    return shop


@pytest.mark.long
def test_tests_whose_models_describe_their_readings_teach_and_a_job_uses_it(shop: Shop) -> None:
    run = shop.run("model", "learn", "earlier", "-o", "priors.yaml")
    assert run.code == 0, run.messages
    told = dict(line.strip().split("  ", 1) for line in run.output.splitlines() if line.startswith("  "))
    assert {name: why.strip() for name, why in told.items()} == {
        "earlier/again.yaml": "learned",
        "earlier/bare.yaml": "left out: it has no error model",
        "earlier/cool.yaml": "left out: the readings of earlier/again.yaml",
        "earlier/deep/warm.yaml": "learned",
        "earlier/a-lacking.yaml": "left out: its model is not adequate (missing)",
    }
    values = shop.run("model", "learn", "earlier", "--json").summary
    assert (values["schema"], values["kind"], values["tests"]) == ("zlmreport/priors/1", "linear", 2)
    assert set(values["effects"]) == {"offset", "backlash", "scale-expansion"}
    printed = shop.run("model", "learn", "earlier").output
    assert printed == (shop.folder / "priors.yaml").read_text(encoding="utf-8")
    diagnosed = shop.run("model", "diagnose", "job.yaml")
    assert diagnosed.code == 0, diagnosed.messages
    assert "expected to be as 2 earlier tests say (model.priors)" in " ".join(diagnosed.output.split())
    assert "earlier" not in shop.run("model", "fit", "job.yaml").output  # no fit depends on them
    assert "scale-expansion" in diagnosed.output


@pytest.mark.long
def test_the_certificate_carries_the_file_and_holds(shop: Shop) -> None:
    shop.write("priors.yaml", _PRIORS)
    assert shop.run("job.yaml", "-o", "out", "--format", "pdf-typst").code == 0
    checked = shop.run("verify", "out/EXAMPLE-2026-0016.pdf", "--json").summary
    assert checked["verdict"] == "holds"
    assert "priors.yaml" in {each["subject"] for each in checked["files"]}


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        ("linear", "rotary", "job.yaml:", "it was learned from rotary axes, and this one is linear"),
        ("tests: 8", "measurand: straightness\ntests: 8", "job.yaml:", "from tests of straightness"),
        ("[1, 3]", "[1]", "priors.yaml:4:", "each ratio has a probability"),
        ("position:", "place:", "priors.yaml:4:", "place"),
        ("zlmreport/priors/1", "zlmreport/job/1", "priors.yaml:1:", "a job"),
    ],
)
def test_a_file_that_says_something_else_is_refused(
    shop: Shop, old: str, new: str, place: str, message: str
) -> None:
    shop.write("priors.yaml", _PRIORS.replace(old, new, 1))
    run = shop.run("check", "job.yaml")
    assert run.code == 2
    assert run.messages.startswith(place)
    assert message in run.messages


def test_what_is_no_file_is_named_and_waited_for_by_nobody(shop: Shop) -> None:
    os.mkfifo(shop.folder / "earlier" / "pipe.yaml")
    (shop.folder / "earlier" / "folder.yaml").mkdir()
    shop.write("earlier/cool.yaml", "")
    for name in ("again", "deep/warm"):
        (shop.folder / "earlier" / f"{name}.yaml").unlink()
    run = shop.run("model", "learn", "earlier")
    assert run.code == 2
    assert "earlier/pipe.yaml: left out: it cannot be read: it is no file but" in run.messages
    assert "earlier/folder.yaml: left out: it cannot be read: it is a folder" in run.messages


def test_tests_of_one_kind_teach_together_however_the_files_are_called(shop: Shop) -> None:
    lacking = (shop.folder / "earlier" / "a-lacking.yaml").read_text(encoding="utf-8")
    for name in ("b", "c"):
        shop.write(f"mixed/{name}.yaml", lacking)
    axis = "name: X, travel: [0, 600], screw_pitch: 10"
    shop.write("mixed/a.yaml", lacking.replace(axis, "name: C, kind: rotary"))
    straight = lacking.replace("measurement:\n", "measurement:\n  error: EYX\n").replace(
        "    - backlash\n", ""
    )
    shop.write("mixed/d.yaml", straight.replace("iso230-2:2014", "iso230-1:2012"))
    told = shop.run("model", "learn", "mixed").messages
    assert "mixed/a.yaml: left out: it is a test of positioning of a rotary axis, and those of" in told
    assert "mixed/b.yaml: left out: its model is not adequate" in told
    assert "mixed/d.yaml: left out: it is a test of straightness of a linear axis, and those of" in told


def test_a_job_is_looked_at_however_its_ending_is_written(shop: Shop) -> None:
    bare = (shop.folder / "earlier" / "bare.yaml").read_text(encoding="utf-8")
    for name in ("a.yml", "b.YAML", "c.Yml", "d.txt"):
        shop.write(f"endings/{name}", bare)
    run = shop.run("model", "learn", "endings")
    assert run.code == 2
    told = [line.split() for line in run.messages.splitlines()[1:]]
    assert [name for name, *_ in told] == ["endings/a.yml:", "endings/b.YAML:", "endings/c.Yml:"]


def test_a_folder_that_teaches_nothing_writes_nothing(shop: Shop) -> None:
    shop.write("empty/laboratory.yaml", "laboratory: {name: Sample}\n")
    run = shop.run("model", "learn", "empty", "-o", "new.yaml")
    assert run.code == 2
    assert "no job in empty has an error model that describes its readings" in run.messages
    assert not (shop.folder / "new.yaml").exists()
    assert shop.run("model", "learn", "nowhere").code == 3
    assert shop.run("model", "fit", "job.yaml", "-o", "new.yaml").code == 2
