"""Everything that a plugin needs comes in by one door, which costs nothing until a name is used."""

from __future__ import annotations

import ast
import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

from zlmreport import plugin

_PLUGINS = Path(__file__).parents[2] / "plugins"
_HOUSE_STANDARD = sorted((_PLUGINS / "zlmreport-house-standard").rglob("*.py"))


def _imported(path: Path) -> set[str]:
    """Return the modules of zlmreport that a file imports."""
    modules: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            modules.add(node.module or "")
        elif isinstance(node, ast.Import):
            modules.update(name.name for name in node.names)
    return {module for module in modules if module.partition(".")[0] == "zlmreport"}


def test_every_name_of_the_door_leads_to_what_it_stands_for() -> None:
    assert [name for name in plugin.__all__ if not hasattr(plugin, name)] == []


def test_a_name_that_the_door_does_not_offer_is_refused() -> None:
    with pytest.raises(AttributeError, match="no attribute 'Nonesuch'"):
        _ = import_module("zlmreport.plugin").Nonesuch


def test_the_door_alone_loads_no_other_module_of_the_house() -> None:
    code = (
        "import sys, zlmreport.plugin; print(*[name for name in sys.modules if name.startswith('zlmreport')])"
    )
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert set(loaded.split()) == {"zlmreport", "zlmreport.plugin", "zlmreport.version"}


def test_the_door_opens_only_on_rooms_below_it() -> None:
    """The tool that holds the order of the rooms sees no imports by name."""
    contracts = tomllib.loads((_PLUGINS.parent / "pyproject.toml").read_text(encoding="utf-8"))
    layers = contracts["tool"]["importlinter"]["contracts"][0]["layers"]
    below = {room.strip() for layer in layers[layers.index("plugin") :] for room in layer.split("|")}
    assert {plugin.home_of(name)[0].split(".")[1] for name in plugin.__all__} <= below


@pytest.mark.parametrize("path", _HOUSE_STANDARD, ids=lambda path: path.name)
def test_the_example_of_a_third_party_imports_only_the_door_and_the_kits(path: Path) -> None:
    allowed = (
        {"zlmreport.plugin", "zlmreport.testing"} if "tests" in path.parts[-2:] else {"zlmreport.plugin"}
    )
    assert _imported(path) <= allowed
