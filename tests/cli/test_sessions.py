"""A job that names further tests of its axis."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from cli.commands import Shop
from environments import ROOT

_CONFIG = ROOT / "configs" / "second-test"


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    """A copy of the example, as the folder to work in."""
    monkeypatch.chdir(tmp_path)
    for file in _CONFIG.iterdir():
        shutil.copy(file, tmp_path)
    return Shop(tmp_path, capsys)


def test_what_one_test_leaves_open_a_second_decides_and_the_effect_is_added(shop: Shop) -> None:
    alone = shop.run("model", "diagnose", "cool.yaml", "--json").summary["candidates"][0]
    assert {alone["effect"], *alone["indistinguishable_from"]} == {"scale-error", "scale-expansion"}
    together = shop.run("model", "diagnose", "together.yaml", "--json").summary
    assert together["verdict"] == "missing"
    assert together["candidates"][0]["effect"] == "scale-expansion"
    assert together["candidates"][0]["indistinguishable_from"] == []
    shop.write(
        "together.yaml",
        (_CONFIG / "together.yaml")
        .read_text(encoding="utf-8")
        .replace("model: {", "model: {effects: [offset, backlash], "),
    )
    added = shop.run("model", "add", "together.yaml", "scale-expansion")
    assert added.code == 0, added.messages
    assert "sessions: [warm.yaml]" in (shop.folder / "together.yaml").read_text(encoding="utf-8")
    assert shop.run("model", "diagnose", "together.yaml", "--json").summary["verdict"] == "adequate"
    history = shop.run("model", "history", "together.yaml", "--json").summary["steps"]
    assert [each["effect"] for each in history] == [
        None,
        "session-zero",
        "offset",
        "backlash",
        "scale-expansion",
    ]


@pytest.mark.long
def test_sessions_never_enter_the_evaluation_and_the_certificate_carries_their_files(shop: Shop) -> None:
    for name, formats in (("cool.yaml", "json"), ("together.yaml", "pdf-typst,json")):
        run = shop.run(name, "-o", "out", "--format", formats)
        assert run.code == 0, run.messages
    alone, together = (
        json.loads((shop.folder / "out" / f"EXAMPLE-2026-00{number}.json").read_text(encoding="utf-8"))
        for number in (16, 18)
    )
    assert alone["evaluations"] == together["evaluations"]
    checked = shop.run("verify", "out/EXAMPLE-2026-0018.pdf", "--json").summary
    assert checked["verdict"] == "holds"
    carried = {each["subject"] for each in checked["files"]}
    assert {"warm.yaml", "warm.csv"} <= carried


@pytest.mark.parametrize(
    ("sessions", "message"),
    [
        ("together.yaml", "this test is in the model already"),
        ("warm.yaml, warm.yaml", "this test is in the model already"),
        ("y.yaml", "it is a test of axis Y (linear) of EXAMPLE-X-16, on EYY;"),
        ("straightness.yaml", "it is a test of axis X (linear) of EXAMPLE-X-16, on EYX;"),
        ("machine.yaml", "it is a test of axis X (linear) of EXAMPLE-X-17, on EXX;"),
    ],
)
def test_a_session_that_is_none_is_refused_where_it_stands(shop: Shop, sessions: str, message: str) -> None:
    warm = (shop.folder / "warm.yaml").read_text(encoding="utf-8")
    shop.write("y.yaml", warm.replace("name: X", "name: Y"))
    of_straightness = warm.replace("iso230-2:2014", '"iso230-1:2012"').replace(
        "source:", "error: EYX\n  source:"
    )
    shop.write("straightness.yaml", of_straightness)
    shop.write("machine.yaml", warm.replace("EXAMPLE-X-16", "EXAMPLE-X-17"))
    text = (shop.folder / "together.yaml").read_text(encoding="utf-8").replace("warm.yaml]", f"{sessions}]")
    shop.write("together.yaml", text)
    run = shop.run("check", "together.yaml")
    assert run.code == 2
    assert run.messages.startswith("together.yaml:5:")
    assert message in run.messages


def test_a_session_that_is_not_there_is_named(shop: Shop) -> None:
    (shop.folder / "warm.yaml").unlink()
    run = shop.run("model", "diagnose", "together.yaml")
    assert run.code == 3
    assert "warm.yaml" in run.messages
