"""``zlmreport new``: what it writes passes its own kit as it is."""

from __future__ import annotations

import importlib.util
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from environments import imported_from
from model.axis_tests import linear_test, noise
from zlmreport.cli import main
from zlmreport.cli.new import GUIDES
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import instruments

ROOT = Path(__file__).parents[2]


@pytest.fixture
def begun(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a function that begins a plugin, and gives its folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path / "my-plugin"))

    def begin(kind: str, *options: str) -> Path:
        assert main(["new", kind, "my-plugin", *options]) == 0
        importlib.invalidate_caches()
        return tmp_path / "my-plugin"

    yield begin
    for name in ("my_plugin", "test_my_plugin"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("kind", [each for each in GUIDES if each != "instrument"])
def test_skeleton_passes_its_kit(kind: str, begun: Any, tmp_path: Path) -> None:
    folder = begun(kind)
    imported_from("my_plugin", folder)
    tests = imported_from("test_my_plugin", folder)
    takes_folder = kind in {"source", "notifier"}
    if kind == "quantity":
        tests.test_standard_conforms()
        tests.test_source_conforms(tmp_path)
    else:
        tests.test_conforms(*([tmp_path] if takes_folder else []))


def test_effect_may_be_called_as_a_word_of_yaml(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "effect", "null"]) == 0
    registry = find_plugins({}, [tmp_path / "null" / "null.yaml"])
    assert "null" in [each.identifier for each in registry.effects]


def test_skeleton_of_an_instrument_brings_what_reads_a_port(begun: Any) -> None:
    folder = begun("instrument")
    for name in ("pyproject.toml", "README.md"):
        assert '"zlmreport[capture]"' in (folder / name).read_text(encoding="utf-8")


def test_skeleton_of_an_instrument_is_read(begun: Any) -> None:
    instrument = imported_from("my_plugin", begun("instrument")).MyPlugin()
    for check in (instruments.is_named, instruments.follows_the_axis, instruments.no_cut_answer_is_usable):
        check(instrument)


@pytest.mark.parametrize("kind", GUIDES)
def test_skeleton_is_found_and_names_a_guide_that_there_is(kind: str, begun: Any) -> None:
    folder = begun(kind)
    registry = find_plugins({}, [folder / "my_plugin.py"])
    offered = {each.identifier for each in registry.list_offers()}
    expected = {"my-plugin:1", "my-plugin-text"} if kind == "quantity" else {"my-plugin"}
    assert expected <= offered
    for path in folder.glob("*.*"):
        assert not re.search(r"\{\{\w{2,}\}\}", path.read_text(encoding="utf-8")), path
    assert (ROOT / "docs" / "how-to" / GUIDES[kind]).is_file()


def test_skeleton_passes_formatter_and_linter(begun: Any) -> None:
    pytest.importorskip("ruff", reason="ruff comes with the group lint, and is not installed")
    for kind in GUIDES:
        folder = begun(kind)
        for command in (["format", "--check"], ["check"]):
            options = ["--line-length", "110", "--isolated", "--no-cache", "."]
            done = subprocess.run(
                [sys.executable, "-m", "ruff", *command, *options],
                capture_output=True,
                cwd=folder,
                text=True,
                check=False,
            )
            assert done.returncode == 0, f"{kind}: {done.stdout}"
        for path in folder.glob("*.*"):
            path.unlink()


def test_what_is_there_is_not_touched(begun: Any, capsys: pytest.CaptureFixture[str]) -> None:
    (begun("effect") / "my_plugin.py").write_text("mine", encoding="utf-8")
    assert main(["new", "standard", "my-plugin"]) != 0
    assert (Path("my-plugin") / "my_plugin.py").read_text(encoding="utf-8") == "mine"
    assert "my_plugin.py" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["standart", "x"], "zlmreport new: there is no kind 'standart'; did you mean 'standard'?"),
        (["effect", "My effect"], "zlmreport new: 'My effect' is no name for a plugin; write lower-case"),
        (["effect", "../x"], "zlmreport new: '../x' is no name for a plugin"),
        (["standard", "class"], "zlmreport new: 'class' is a word of Python, which no module is called"),
        (["standard", "true"], "zlmreport new: 'true' is a word of Python, which no module is called"),
        (
            ["standard", "numpy"],
            "zlmreport new: there is a module 'numpy' already, and Python would take one",
        ),
        (["renderer", "json"], "zlmreport new: there is a module 'json' already"),
        (["renderer", "pdf"], "zlmreport new: a plugin provides format 'pdf' already, and jobs could name"),
        (["effect", "backlash"], "zlmreport new: a plugin provides effect 'backlash' already"),
        (["source", "x", "--from", "job.yaml"], "zlmreport new: --from takes a formula, which is an effect"),
    ],
)
def test_wrong_command_line_is_told(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", *arguments]) == 2
    assert capsys.readouterr().err.startswith(sentence)
    assert not list(tmp_path.iterdir())


_JOB = """schema: zlmreport/job/1
certificate: {{number: OWN-1, kind: report}}
axis: {{name: X, kind: linear, travel: [0, 1000]}}
measurement: {{date: 2026-01-05, source: {{plugin: laser-csv, file: x.csv}}}}
evaluate: [iso230-2:2014]
model:
  effects:
    - offset
    - {effect}
"""
_UM, _MM = "{unit: um, range: [-20, 20]}", "{unit: mm, range: [60, 500]}"
_FORMULAS = [
    ("a*sin(2*pi*P/L) + b*cos(2*pi*P/L)", f"{{a: {_UM}, b: {_UM}, L: {_MM}}}"),
    ("a*D*exp(-(P - 300)^2/lambda^2)", f"{{a: {_UM}, lambda: {_MM}}}"),
    (
        "k*(axis_temperature - 20)*P + a*(1 - exp(-t/T))",
        "{k: {unit: um/(m K)}, a: {unit: um}, T: {unit: s, value: 900}}",
    ),
    ("a*min(P/L, run)*step(P - 200) - s*abs(P - 500)", f"{{a: {_UM}, s: {{unit: um/m}}, L: {_MM}}}"),
]


@pytest.mark.parametrize(("formula", "parameters"), _FORMULAS, ids=["wave", "bump", "warmth", "kinks"])
def test_formula_becomes_a_plugin_that_gives_the_same_fit(
    formula: str, parameters: str, begun: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    design = linear_test(15, 3)
    rows = zip(
        design.position * 1e3,
        design.direction,
        design.run,
        3 * np.sin(design.position * 20) + noise(design) * 1e6,
        design.time,
        design.conditions["axis_temperature"] - 273.15,
        strict=True,
    )
    lines = ["target,direction,run,deviation,time,axis_temperature"]
    lines += [",".join(f"{each:.12g}" for each in row) for row in rows]
    (tmp_path / "x.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    written = f'{{name: my-plugin, formula: "{formula}", parameters: {parameters}}}'
    job = tmp_path / "job.yaml"
    job.write_text(_JOB.format(effect=written), encoding="utf-8")
    capsys.readouterr()
    assert main(["model", "fit", str(job), "--json"]) == 0
    expected = json.loads(capsys.readouterr().out)
    folder = begun("effect", "--from", str(job))
    named = capsys.readouterr().out.partition("instead of the formula: ")[2].strip()
    imported_from("my_plugin", folder)
    imported_from("test_my_plugin", folder).test_conforms()
    job.write_text(_JOB.format(effect=named), encoding="utf-8")
    assert main(["model", "fit", str(job), "--json", "--plugin", str(folder / "my_plugin.py")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["error"]["rms"] == pytest.approx(expected["error"]["rms"], rel=1e-9)
    values = {each["name"]: each["value"] for each in found["model"]["parameters"]}
    of_formula = {each["name"]: each["value"] for each in expected["model"]["parameters"]}
    assert values == pytest.approx({name: of_formula[name] for name in values}, rel=1e-6, abs=1e-9)
    left = [each["residual"] for each in found["residuals"]]
    assert left == pytest.approx([each["residual"] for each in expected["residuals"]], abs=1e-6)
