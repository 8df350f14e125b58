"""``zlmreport new``: what it writes passes its own kit as it is."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from zlmreport.cli import main
from zlmreport.cli.new import GUIDES
from zlmreport.plugins import find_plugins
from zlmreport.testing import instruments

ROOT = Path(__file__).parents[2]
FORMATTER = (sys.executable, "-m", "ruff", "format", "--check", "--line-length", "110", "--isolated")


@pytest.fixture
def begun(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a function that begins a plugin, and gives its folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path / "my-plugin"))

    def begin(kind: str) -> Path:
        assert main(["new", kind, "my-plugin"]) == 0
        importlib.invalidate_caches()
        return tmp_path / "my-plugin"

    yield begin
    for name in ("my_plugin", "test_my_plugin"):
        sys.modules.pop(name, None)


def _imported(name: str, folder: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, folder / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("kind", [each for each in GUIDES if each != "instrument"])
def test_skeleton_passes_its_kit(kind: str, begun: Any, tmp_path: Path) -> None:
    folder = begun(kind)
    _imported("my_plugin", folder)
    tests = _imported("test_my_plugin", folder)
    takes_folder = kind in {"source", "notifier"}
    tests.test_conforms(*([tmp_path] if takes_folder else []))
    if kind == "standard":
        tests.test_printed_example()


def test_skeleton_of_an_instrument_is_read(begun: Any) -> None:
    instrument = _imported("my_plugin", begun("instrument")).MyPlugin()
    for check in (instruments.is_named, instruments.follows_the_axis, instruments.no_cut_answer_is_usable):
        check(instrument)


@pytest.mark.parametrize("kind", GUIDES)
def test_skeleton_is_found_and_names_a_guide_that_there_is(kind: str, begun: Any) -> None:
    folder = begun(kind)
    registry = find_plugins({}, [folder / "my_plugin.py"])
    assert "my-plugin" in {each.identifier for each in registry.offers()}
    for path in folder.glob("*.*"):
        assert "{{" not in path.read_text(encoding="utf-8").replace("{{7*7}}", ""), path
    assert (ROOT / "docs" / "how-to" / GUIDES[kind]).is_file()


def test_skeleton_is_as_the_formatter_leaves_it(begun: Any) -> None:
    pytest.importorskip("ruff", reason="the formatter comes with the group lint, and is not installed")
    for kind in GUIDES:
        folder = begun(kind)
        formatted = subprocess.run(
            [
                sys.executable,
                "-m",
                "ruff",
                "format",
                "--check",
                "--line-length",
                "110",
                "--isolated",
                str(folder),
            ],
            capture_output=True,
            text=True,
            check=False,
        )
        assert formatted.returncode == 0, formatted.stdout
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
    ],
)
def test_wrong_command_line_is_told(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", *arguments]) == 2
    assert capsys.readouterr().err.startswith(sentence)
    assert not list(tmp_path.iterdir())
